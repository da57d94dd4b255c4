#include "skein/layer/reasoning/planning/search/lower_bound.h"

#include <cmath>
#include <limits>

#include "skein/layer/reasoning/planning/search/ways.h"

namespace skein::planning {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kMargin = 0.02;    // about corners [m]
constexpr std::int64_t kShare = 8;  // of what is left, for the bound

bool always(const Zone& z) {
  return z.floor_msl == -kInfinity && z.ceiling_msl == kInfinity &&
         z.from == -kInfinity && z.until == kInfinity;
}

}  // namespace

LowerBound lower_bound(const PathQuery& query, Effort& effort) {
  std::vector<Zone> zones;
  if (query.airspace != nullptr)
    for (const Zone& zone : query.airspace->zones)
      if (always(zone)) zones.push_back(zone);
  if (zones.empty()) return {};
  const GroundSpeed speed(query.limits.airspeed, query.wind);
  WayRequest request;
  request.start = geo::horizontal(query.start.p_N);
  request.goal = geo::horizontal(query.goal.p_N);
  const Ways found =
      ways_around(zones, {}, speed, request, {0, kMargin}, effort.part(kShare));
  effort.spend(found.states);
  if (found.ways.empty()) return {found.complete ? kInfinity : 0};
  double more = 0;  // what the margin adds [m]
  for (const Way::Arc& arc : found.ways.front().arcs)
    if (arc.round.corner) more += kMargin * arc.turned;
  return {found.ways.front().time - more / speed.slowest()};
}

}  // namespace skein::planning
