// SPDX-License-Identifier: Apache-2.0
#include "skein/solve/path/lower_bound.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "skein/base/math.h"
#include "skein/solve/path/detours.h"

namespace skein::solve {
namespace {

constexpr double kCornerMargin = 1e-5;  // about corners [m]
constexpr double kAside = 1e-6;         // of a disc that begins at the start or goal [m]
constexpr double kSameTime = 1e-9;      // two arrivals in one place [s]
constexpr std::int64_t kShare = 8;      // of what is left, for the bound

bool always(const Zone& z) {
  return z.floor_msl == -math::kInfinity && z.ceiling_msl == math::kInfinity &&
         z.from == -math::kInfinity && z.until == math::kInfinity;
}

// A disc at whose rim the start or the goal lies has no tangents from there: it is made
// a little smaller, which makes no flight slower. Nothing where nothing is left.
std::optional<Zone> around_ends(const Zone& zone, const DetourRequest& request) {
  const auto* disc = std::get_if<Disc>(&zone.area);
  if (disc == nullptr) return zone;
  const double nearest = std::min((request.start - disc->centre).norm(),
                                  (request.goal - disc->centre).norm());
  if (nearest > disc->radius + kAside) return zone;
  if (nearest <= 2 * kAside) return std::nullopt;
  Zone smaller = zone;
  smaller.area = Disc{disc->centre, nearest - kAside};
  return smaller;
}

// By how much the time past a zone may be too long [s].
double inexactness(const Zone& zone, const GroundSpeed& speed) {
  constexpr double kArcs = 4;  // along one disc
  if (const auto* disc = std::get_if<Disc>(&zone.area))
    return kArcs * (disc->radius * speed.arc_error() + kSameTime);
  const auto corners = static_cast<double>(std::get<geo::Ring>(zone.area).size());
  return corners * (geo::kPi * kCornerMargin / speed.slowest() + kSameTime);
}

}  // namespace

LowerBound lower_bound(const PathQuery& query, SearchBudget& budget) {
  DetourRequest request;
  request.start = geo::horizontal(query.start.p_N);
  request.goal = geo::horizontal(query.goal.p_N);
  std::vector<Zone> zones;
  if (query.airspace != nullptr)
    for (const Zone& zone : query.airspace->zones) {
      if (!always(zone)) continue;
      if (auto kept = around_ends(zone, request)) zones.push_back(*std::move(kept));
    }
  if (zones.empty()) return {};
  const GroundSpeed speed(query.limits.airspeed, query.wind);
  // What sums may be off by, whichever the quickest path is: it turns by half a circle at
  // each corner at most.
  double inexact = kSameTime;  // [s]
  for (const Zone& zone : zones) inexact += inexactness(zone, speed);
  const Detours found =
      detours_around(zones, {}, speed, request, {0, kCornerMargin}, budget.part(kShare));
  budget.spend(found.expansions);
  if (found.detours.empty()) return {found.complete ? math::kInfinity : 0};
  return {std::max(0.0, found.detours.front().time - inexact)};
}

}  // namespace skein::solve
