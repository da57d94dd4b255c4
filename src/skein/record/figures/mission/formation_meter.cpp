// SPDX-License-Identifier: Apache-2.0
#include "skein/record/figures/mission/formation_meter.h"

#include <algorithm>
#include <cmath>

#include "skein/geo/vec.h"

namespace skein::record {
namespace {

constexpr double kInPlace = 30;  // [m]

}  // namespace

void FormationMeter::goal_changed(const MissionGoal& goal) {
  if (const auto* formation = std::get_if<FormationGoal>(&goal)) goal_ = *formation;
}

void FormationMeter::moved(Time /*time*/, EntityId id, const Vec2& from, const Vec2& to) {
  if (id != goal_.leader &&
      std::count(goal_.followers.begin(), goal_.followers.end(), id) == 0)
    return;
  Flight& flight = flights_[id];
  flight.place = to;
  flight.there = true;
  if (from != to) flight.course = (to - from).normalized();
}

void FormationMeter::tick(Time /*now*/) {
  const auto leader = flights_.find(goal_.leader);
  const bool leads =
      leader != flights_.end() && leader->second.there && !leader->second.course.isZero();
  for (std::size_t k = 0; k < goal_.followers.size() && k < goal_.slots.size(); ++k) {
    const auto found = flights_.find(goal_.followers[k]);
    if (found == flights_.end() || !found->second.there) continue;
    Flight& follower = found->second;
    if (!leads) {
      // Nobody is at a place beside a leader that is gone.
      if (follower.arrived) ++follower.seconds;
      continue;
    }
    const Vec2 ahead = leader->second.course;
    const Vec2 slot = leader->second.place + goal_.slots[k].x() * ahead +
                      goal_.slots[k].y() * geo::turned_right(ahead);
    const double error = (follower.place - slot).norm();
    follower.arrived = follower.arrived || error < kInPlace;
    if (!follower.arrived) continue;
    errors_.push_back(static_cast<float>(error));
    ++follower.seconds;
    if (error < kInPlace) ++follower.in_place;
  }
  if (leads) leader->second.arrived = true;
  for (auto one = flights_.begin(); one != flights_.end(); ++one)
    for (auto other = std::next(one); other != flights_.end(); ++other) {
      const Flight &a = one->second, &b = other->second;
      if (!a.there || !b.there || !a.arrived || !b.arrived) continue;
      const double distance = (a.place - b.place).norm();
      apart_ = std::min(apart_.value_or(distance), distance);
    }
}

void FormationMeter::left(EntityId id) {
  if (const auto found = flights_.find(id); found != flights_.end())
    found->second.there = false;
}

std::vector<MissionFigure> FormationMeter::figures(Time /*now*/) const {
  std::vector<MissionFigure> all;
  if (!errors_.empty()) {
    std::vector<float> sorted = errors_;
    std::sort(sorted.begin(), sorted.end());
    double sum = 0;
    for (const float error : sorted) sum += error;
    const auto last = static_cast<double>(sorted.size() - 1);
    all.push_back({"slot_error_mean_m", sum / (last + 1)});
    all.push_back(
        {"slot_error_95_m", sorted[static_cast<std::size_t>(std::ceil(0.95 * last))]});
    all.push_back({"slot_error_max_m", sorted.back()});
  }
  double shares = 0;
  int counted = 0;
  for (const auto& [id, flight] : flights_) {
    if (flight.seconds == 0) continue;
    shares += static_cast<double>(flight.in_place) / flight.seconds;
    ++counted;
  }
  if (counted > 0) all.push_back({"in_place", shares / counted});
  if (apart_) all.push_back({"apart_min_m", *apart_});
  return all;
}

}  // namespace skein::record
