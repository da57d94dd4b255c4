// SPDX-License-Identifier: Apache-2.0
#include "skein/solve/path/aa_star.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "skein/base/math.h"
#include "skein/model/path/flight_plan.h"
#include "skein/solve/path/detour_trajectory.h"
#include "skein/solve/path/levels.h"
#include "skein/solve/path/lower_bound.h"
#include "skein/solve/path/manoeuvre_search.h"
#include "skein/solve/path/query_check.h"

namespace skein::solve {
namespace {

// Routes keep this far from discs and corners, so that rounding is no conflict [m].
constexpr double kDetourMargin = 0.02;
struct Try {
  int detours;
  double heuristic_weight;
};
constexpr std::array<Try, 4> kAttempts = {{{1, 1}, {1, 1.1}, {1, 1.5}, {3, 1}}};
constexpr std::int64_t kDetourShare = 6;  // each may use this part of the expansions left
// By which part of the best path's time other routes may seem longer at first.
constexpr double kDetourSlack = 0.05;

// Finer and with a smaller heuristic weight from pass to pass; each may use a part of
// what is left.
struct Pass {
  double finest, heuristic_weight, share;
};
constexpr std::array<Pass, 6> kPasses = {{{1, 2.5, 0.25},
                                          {0.5, 1.7, 0.3},
                                          {0.5, 1.2, 0.3},
                                          {0.25, 1.2, 0.5},
                                          {0.25, 1, 0.5},
                                          {0.125, 1, 1}}};

// Whether routes can begin and end along every disc: within their margin none does.
bool have_room(const std::vector<Zone>& zones, const DetourRequest& request) {
  return std::all_of(zones.begin(), zones.end(), [&](const Zone& zone) {
    const auto* disc = std::get_if<Disc>(&zone.area);
    if (disc == nullptr) return true;
    const double room = disc->radius + kDetourMargin;
    return (request.start - disc->centre).norm() >= room &&
           (request.goal - disc->centre).norm() >= room;
  });
}

class Planning {
 public:
  Planning(const PathQuery& query, AirspaceMap& map, const AaStar::Options& options)
      : query_(query), map_(map), options_(options), budget_(query.budget) {}

  PlannedPath run();

 private:
  bool good() const { return best_.duration <= best_.bound * (1 + options_.gap); }
  bool done() const {
    return budget_.ended() || good() || shortest_ ||
           (query_.budget.first && !best_.plan.empty());
  }
  void take(FlightPlan plan);
  void take(std::optional<Trajectory> trajectory);
  void take_direct();
  void take_detours();
  void take_levels();
  void take_waits();
  void follow(const Detour& detour, bool quickest);
  bool fly_exactly(const Detour& detour);
  void search();
  PlannedPath answer();

  const PathQuery& query_;
  AirspaceMap& map_;
  AaStar::Options options_;
  SearchBudget budget_;
  PlannedPath best_;
  bool shortest_ = false, exhausted_ = false, followed_ = false;
};

void Planning::take(FlightPlan plan) {
  const double time = model::duration(plan);
  if (time >= best_.duration || !map_.is_free(plan)) return;
  best_.plan = std::move(plan);
  best_.duration = time;
  budget_.has_path();
}

void Planning::take(std::optional<Trajectory> trajectory) {
  if (!trajectory) return;
  take(to_flight_plan(*trajectory, query_));
  if (query_.budget.first) return;
  improve(*trajectory, map_, budget_);
  take(to_flight_plan(*trajectory, query_));
}

void Planning::take_direct() {
  const auto direct = make_trajectory({{query_.start}, {query_.goal}}, query_);
  budget_.spend();
  if (!direct) return;
  FlightPlan plan = to_flight_plan(*direct, query_);
  if (map_.is_free(plan)) {
    best_.duration = direct->duration();
    best_.plan = std::move(plan);
    budget_.has_path();
    if (done()) return;
  }
  take(swerve(*direct, map_, budget_));
}

// Exact where turns along all arcs can be flown. The whole route then is the shortest of
// its kind.
bool Planning::fly_exactly(const Detour& detour) {
  if (!query_.wind.isZero()) return false;
  for (const Detour::Arc& arc : detour.arcs)
    if (arc.turned > 0 && arc.obstacle.radius < query_.limits.turn_radius * (1 - 1e-12))
      return false;
  FlightPlan plan = fly_detour(detour, query_);
  const double climb = query_.start.p_N.z() - query_.goal.p_N.z();
  if (climb_time(climb, query_.limits) > model::duration(plan) * (1 + 1e-9)) return false;
  if (!map_.is_free(plan)) return false;
  take(std::move(plan));
  return true;
}

void Planning::take_detours() {
  if (query_.airspace == nullptr || query_.airspace->zones.empty()) return;
  const double a = -query_.start.p_N.z(), b = -query_.goal.p_N.z();
  std::vector<Zone> zones;
  for (const Zone& z : query_.airspace->zones) {
    const bool met = z.ceiling_msl >= std::min(a, b) && z.floor_msl <= std::max(a, b) &&
                     z.until >= query_.start_time;
    if (met) zones.push_back(z);
  }
  const GroundSpeed speed(query_.limits.airspeed, query_.wind);
  DetourRequest request;
  request.start = geo::horizontal(query_.start.p_N);
  request.goal = geo::horizontal(query_.goal.p_N);
  const auto course = [&](double heading) {
    return geo::bearing(query_.limits.airspeed * geo::unit(heading) + query_.wind);
  };
  request.start_course = course(query_.start.heading);
  request.goal_course = course(query_.goal.heading);
  request.turn_radius = query_.limits.turn_radius;
  request.start_time = query_.start_time;
  request.start_altitude = a;
  request.goal_altitude = b;
  const bool exact = a == b && !map_.is_timed() && have_room(zones, request);
  // One to have a path, the quickest if that is not too much work; then others.
  for (const Try& t : kAttempts) {
    if (done()) return;
    if (t.heuristic_weight > 1 && !best_.plan.empty() && followed_) continue;
    request.detours = t.detours;
    request.heuristic_weight = t.heuristic_weight;
    request.max_time = best_.duration * (1 + kDetourSlack);
    const Detours found =
        detours_around(zones, query_, speed, request, {kDetourMargin, kDetourMargin},
                       budget_.part(kDetourShare));
    budget_.spend(found.expansions);
    const bool quickest = t.heuristic_weight == 1 && exact;
    for (std::size_t i = followed_ && t.detours > 1 ? 1 : 0;
         i < found.detours.size() && !done(); ++i)
      follow(found.detours[i], quickest && i == 0);
    if (query_.budget.first && !best_.plan.empty()) return;
  }
}

void Planning::follow(const Detour& detour, bool quickest) {
  followed_ = true;
  if (fly_exactly(detour)) {
    shortest_ = quickest;
    return;
  }
  // A route that cannot be flown as it is still shows where to pass.
  auto trajectory = follow_detour(detour, map_, budget_, Detail::kCoarse);
  if (!trajectory && !done())
    trajectory = follow_detour(detour, map_, budget_, Detail::kFine);
  take(std::move(trajectory));
}

// Up or down to what lies over and under zones and the ground, across, and back.
void Planning::take_levels() {
  for (const double level : levels_between(map_)) {
    if (done()) return;
    // Up at the start and down at the goal, or in between.
    for (const double part : {0.5, 0.25, 0.0}) {
      FlightState begin = query_.start, end = query_.goal;
      const Vec3 straight = query_.goal.p_N - query_.start.p_N;
      begin.p_N += part * straight;
      end.p_N -= part * straight;
      begin.p_N.z() = end.p_N.z() = -level;
      if (part > 0) begin.heading = end.heading = geo::bearing(geo::horizontal(straight));
      std::vector<Waypoint> vias = {{query_.start}, {begin}, {end}, {query_.goal}};
      if (part == 0.5) vias.erase(vias.begin() + 2);
      auto trajectory = make_trajectory(std::move(vias), query_);
      budget_.spend();
      if (!trajectory || trajectory->duration() >= best_.duration) continue;
      if (!map_.is_free(to_flight_plan(*trajectory, query_)))
        trajectory = swerve(std::move(*trajectory), map_, budget_, 3);
      take(std::move(trajectory));
    }
  }
}

// Circling at the start until something has gone, by steps of a quarter turn.
void Planning::take_waits() {
  constexpr int kSteps = 24;
  constexpr double kGrowth = 1.25;
  const double turn = full_turn(query_);
  double before = 0, wait = turn;
  for (int i = 0; i < kSteps && !done(); ++i, wait *= kGrowth) {
    if (best_.duration <= before + best_.bound) return;
    budget_.spend();
    auto trajectory = make_trajectory({{query_.start, wait}, {query_.goal}}, query_);
    if (!trajectory || !map_.is_free(to_flight_plan(*trajectory, query_))) {
      before = wait;
      continue;
    }
    for (int k = 0; k < 12 && before > 0 && wait - before > 0.1; ++k) {
      const double half = (before + wait) / 2;
      auto sooner = make_trajectory({{query_.start, half}, {query_.goal}}, query_);
      const bool free = sooner && map_.is_free(to_flight_plan(*sooner, query_));
      (free ? wait : before) = half;
      if (free) trajectory = std::move(sooner);
    }
    take(std::move(trajectory));
    return;
  }
}

void Planning::search() {
  for (const Pass& each : kPasses) {
    if (done()) return;
    SearchPass pass;
    pass.finest = each.finest;
    pass.heuristic_weight = each.heuristic_weight;
    pass.better = best_.duration;
    pass.first = query_.budget.first || best_.plan.empty();
    pass.expansions =
        static_cast<std::int64_t>(each.share * static_cast<double>(budget_.left()));
    SearchResult result = search_manoeuvres(map_, pass, budget_);
    take(std::move(result.trajectory));
    exhausted_ = result.exhausted && &each == &kPasses.back();
  }
}

PlannedPath Planning::answer() {
  best_.expansions = budget_.expansions();
  if (!best_.plan.empty()) {
    best_.bound = std::min(best_.bound, best_.duration);
    const bool all = exhausted_ || (!options_.manoeuvres && !done());
    const bool found = good() || shortest_ || all;
    best_.outcome = found ? PlanningOutcome::kFound : PlanningOutcome::kBudgetEnded;
    return std::move(best_);
  }
  const bool all = !budget_.ended() && (exhausted_ || !options_.manoeuvres);
  best_.outcome = all ? PlanningOutcome::kNoPath : PlanningOutcome::kNothingFound;
  best_.reason =
      all ? "no path was found, and nothing is left to look at; that does not prove that "
            "there is none"
          : fmt::format("the budget ended after {} expansions, before the first path",
                        best_.expansions);
  return std::move(best_);
}

PlannedPath Planning::run() {
  const Link direct = link(query_.start, query_.goal, query_);
  const double min = min_time(direct, query_.start, query_.goal, query_);
  if (auto refused = refuse_blocked(map_, query_.start_time + min)) return *refused;
  best_.bound = min;
  if (query_.start.p_N == query_.goal.p_N && direct.duration == 0) {
    best_.outcome = PlanningOutcome::kFound;
    best_.reason = "the start is the goal";
    best_.duration = 0;
    return best_;
  }
  take_direct();
  if (done()) return answer();
  const LowerBound bound = lower_bound(query_, budget_);
  const bool parted = bound.time == math::kInfinity;
  if (!parted) best_.bound = std::max(best_.bound, bound.time);
  // A path that there is already lies as deep in zones as is allowed.
  if (parted && best_.plan.empty()) {
    best_.bound = 0;
    best_.outcome = PlanningOutcome::kNoPath;
    best_.reason =
        "zones that hold at all times and altitudes part the goal from the start";
    best_.expansions = budget_.expansions();
    return best_;
  }
  if (options_.detours && !done()) take_detours();
  if (!done()) take_levels();
  if (map_.is_timed() && !done()) take_waits();
  if (options_.manoeuvres) search();
  return answer();
}

}  // namespace

PlannedPath AaStar::plan(const PathQuery& query) const {
  if (auto refused = refuse_airspace(query)) return *refused;
  if (auto refused = refuse_flight(query)) return *refused;
  AirspaceMap map(query);
  return Planning(query, map, options_).run();
}

PlannedPath AaStar::plan(const PathQuery& query, AirspaceMap& map) const {
  if (auto refused = refuse_flight(query)) return *refused;
  map.ask(query);
  return Planning(query, map, options_).run();
}

}  // namespace skein::solve
