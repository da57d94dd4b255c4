// SPDX-License-Identifier: Apache-2.0
#include "skein/solve/path/lower_bound.h"

#include <cmath>

#include "skein/base/math.h"
#include "skein/solve/path/detours.h"

namespace skein::solve {
namespace {

constexpr double kCornerMargin = 0.02;  // about corners [m]
constexpr std::int64_t kShare = 8;      // of what is left, for the bound

bool always(const Zone& z) {
  return z.floor_msl == -math::kInfinity && z.ceiling_msl == math::kInfinity &&
         z.from == -math::kInfinity && z.until == math::kInfinity;
}

}  // namespace

LowerBound lower_bound(const PathQuery& query, SearchBudget& budget) {
  std::vector<Zone> zones;
  if (query.airspace != nullptr)
    for (const Zone& zone : query.airspace->zones)
      if (always(zone)) zones.push_back(zone);
  if (zones.empty()) return {};
  const GroundSpeed speed(query.limits.airspeed, query.wind);
  DetourRequest request;
  request.start = geo::horizontal(query.start.p_N);
  request.goal = geo::horizontal(query.goal.p_N);
  const Detours found =
      detours_around(zones, {}, speed, request, {0, kCornerMargin}, budget.part(kShare));
  budget.spend(found.expansions);
  if (found.detours.empty()) return {found.complete ? math::kInfinity : 0};
  double more = 0;  // what the margin adds [m]
  for (const Detour::Arc& arc : found.detours.front().arcs)
    if (arc.obstacle.corner) more += kCornerMargin * arc.turned;
  return {found.detours.front().time - more / speed.slowest()};
}

}  // namespace skein::solve
