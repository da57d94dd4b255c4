#include "skein/layer/reasoning/avoidance/flights/conflicts.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace skein::reasoning {
namespace {

double half_metres(double distance) {
  return std::ceil(2 * distance) / 2;
}

}  // namespace

Separation separation_of(const OwnFlight& own, const TeamFlight& other, double unknown) {
  const Separation pair = larger(own.separation, other.separation);
  return {half_metres(pair.horizontal + own.across_error + other.across_error + unknown),
          half_metres(pair.vertical + own.height_error + other.height_error)};
}

Separation separation_between(const TeamFlight& a, const TeamFlight& b) {
  return separation_of({{}, 0, a.separation, a.across_error, a.height_error}, b);
}

std::vector<Conflict> ConflictFinder::find(Time now, const OwnFlight& own,
                                           std::span<const TeamFlight> others,
                                           double until) {
  const double t = now.seconds();
  std::vector<Conflict> all;
  for (const TeamFlight& other : others) {
    const TeamFlight::Expected expected = other.expected(now);
    if (!expected.plan) continue;
    const Separation separation = separation_of(own, other, expected.unknown);
    Looked& looked = looked_[other.who];
    const bool same = looked.own == own.number && looked.other == expected.number &&
                      looked.separation.horizontal == separation.horizontal &&
                      looked.separation.vertical == separation.vertical;
    if (!same || (looked.meeting && looked.meeting->end <= t))
      looked = {own.number, expected.number, separation,
                first_meeting(own.plan, *expected.plan, separation, t,
                              std::numeric_limits<double>::infinity())};
    if (looked.meeting && looked.meeting->begin < until)
      all.push_back({other.who, *looked.meeting, separation});
  }
  std::erase_if(looked_, [&](const auto& each) {
    return !std::ranges::binary_search(others, each.first, {}, &TeamFlight::who);
  });
  std::ranges::stable_sort(all, {}, [](const Conflict& c) { return c.meeting.begin; });
  return all;
}

}  // namespace skein::reasoning
