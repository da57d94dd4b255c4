// SPDX-License-Identifier: Apache-2.0
#include "skein/solve/path/trajectory.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "skein/model/path/flight_plan.h"

namespace skein::solve {
namespace {

// The budget's stop is asked once in so many expansions.
constexpr std::int64_t kBetweenAsking = 64;
// Gains below this are none [s].
constexpr double kGain = 1e-6;
constexpr int kMaxSweeps = 400;

// A new piece of a trajectory in place of what is between states `first` and `last`.
struct Change {
  std::size_t first, last;
  double wait;  // at the first
  std::vector<Waypoint> between;
};

class Improver {
 public:
  Improver(Trajectory& trajectory, const AirspaceMap& map, SearchBudget& budget)
      : trajectory_(trajectory), map_(map), query_(map.query()), budget_(budget) {}

  bool leave_out();
  bool move(double step);

 private:
  bool try_change(const Change& change);
  bool rest_free(std::size_t from, double later) const;

  Trajectory& trajectory_;
  const AirspaceMap& map_;
  const PathQuery& query_;
  SearchBudget& budget_;
};

// Where something depends on time, what follows a change has to be looked at anew.
bool Improver::rest_free(std::size_t from, double later) const {
  if (!map_.is_timed()) return true;
  for (std::size_t i = from; i + 1 < trajectory_.waypoints.size(); ++i) {
    const Waypoint& via = trajectory_.waypoints[i];
    const Link l = link(via.at, trajectory_.waypoints[i + 1].at, query_, via.wait);
    if (!map_.is_free(to_flight_plan(l, via.at, trajectory_.times[i] + later, query_)))
      return false;
  }
  return true;
}

bool Improver::try_change(const Change& change) {
  std::vector<Waypoint> waypoints = {trajectory_.waypoints[change.first]};
  waypoints.front().wait = change.wait;
  waypoints.insert(waypoints.end(), change.between.begin(), change.between.end());
  waypoints.push_back(trajectory_.waypoints[change.last]);
  std::vector<double> times = {trajectory_.times[change.first]};
  std::vector<Link> links;
  for (std::size_t i = 0; i + 1 < waypoints.size(); ++i) {
    budget_.spend();
    links.push_back(
        link(waypoints[i].at, waypoints[i + 1].at, query_, waypoints[i].wait));
    times.push_back(times.back() + links.back().duration);
    if (!(times.back() < trajectory_.times[change.last] - kGain)) return false;
  }
  for (std::size_t i = 0; i < links.size(); ++i)
    if (!map_.is_free(to_flight_plan(links[i], waypoints[i].at, times[i], query_)))
      return false;
  const double later = times.back() - trajectory_.times[change.last];
  if (!rest_free(change.last, later)) return false;
  for (std::size_t i = change.last; i < trajectory_.times.size(); ++i)
    trajectory_.times[i] += later;
  const auto replace = [&](auto& list, const auto& with) {
    const auto at = [&](std::size_t i) {
      return list.begin() + static_cast<std::ptrdiff_t>(i);
    };
    list.insert(list.erase(at(change.first), at(change.last)), with.begin(),
                with.end() - 1);
  };
  replace(trajectory_.waypoints, waypoints);
  replace(trajectory_.times, times);
  return true;
}

bool Improver::leave_out() {
  bool any = false;
  for (std::size_t i = 1; i + 1 < trajectory_.waypoints.size() && !budget_.ended();) {
    const bool gone = try_change({i - 1, i + 1, trajectory_.waypoints[i - 1].wait, {}});
    any |= gone;
    if (!gone) ++i;
  }
  for (std::size_t i = 0; i + 1 < trajectory_.waypoints.size() && !budget_.ended(); ++i)
    any |= trajectory_.waypoints[i].wait > 0 && try_change({i, i + 1, 0, {}});
  return any;
}

bool Improver::move(double step) {
  const double turn = step / query_.limits.turn_radius;
  const bool level = std::all_of(
      trajectory_.waypoints.begin(), trajectory_.waypoints.end(), [&](const Waypoint& v) {
        return v.at.p_N.z() == trajectory_.waypoints.front().at.p_N.z();
      });
  bool any = false;
  for (std::size_t i = 0; i + 1 < trajectory_.waypoints.size() && !budget_.ended(); ++i) {
    const double wait = trajectory_.waypoints[i].wait - step / query_.limits.airspeed;
    if (wait >= full_turn(query_)) any |= try_change({i, i + 1, wait, {}});
  }
  for (std::size_t i = 1; i + 1 < trajectory_.waypoints.size(); ++i) {
    const auto shifted = [&](double along, double across, double up, double heading) {
      Waypoint via = trajectory_.waypoints[i];
      const Vec2 u = geo::unit(via.at.heading);
      via.at.p_N.head<2>() += along * u + across * geo::turned_right(u);
      via.at.p_N.z() -= up;
      via.at.heading += heading;
      return try_change({i - 1, i + 1, trajectory_.waypoints[i - 1].wait, {via}});
    };
    for (const double a : {step, -step}) {
      if (budget_.ended()) return any;
      const double h = a > 0 ? turn : -turn;
      any |= shifted(0, a, 0, 0) || shifted(0, 0, 0, h) || shifted(a, 0, 0, 0) ||
             shifted(step, 0, 0, h) || shifted(-step, 0, 0, h) || shifted(0, a, 0, h) ||
             shifted(0, a, 0, -h) || (!level && shifted(0, 0, a, 0));
    }
  }
  return any;
}

}  // namespace

bool SearchBudget::spend(std::int64_t expansions) {
  expansions_ += expansions;
  if (expansions_ >= budget_->expansions) ended_ = true;
  if (!ended_ && expansions_ >= asked_) {
    asked_ = expansions_ + kBetweenAsking;
    ended_ = budget_->ends_at(has_path_ ? budget_->first_expansions : expansions_);
  }
  return !ended_;
}

PlanningBudget SearchBudget::part(std::int64_t share) const {
  PlanningBudget part = *budget_;
  part.expansions = left() / share;
  part.first_expansions = has_path_ ? 0 : budget_->first_expansions - expansions_;
  return part;
}

std::optional<Trajectory> make_trajectory(std::vector<Waypoint> waypoints,
                                          const PathQuery& query) {
  Trajectory trajectory;
  trajectory.waypoints = std::move(waypoints);
  double time = query.start_time;
  trajectory.times.push_back(time);
  for (std::size_t i = 0; i + 1 < trajectory.waypoints.size(); ++i) {
    time += link(trajectory.waypoints[i].at, trajectory.waypoints[i + 1].at, query,
                 trajectory.waypoints[i].wait)
                .duration;
    trajectory.times.push_back(time);
  }
  if (!std::isfinite(time)) return std::nullopt;
  return trajectory;
}

FlightPlan to_flight_plan(const Trajectory& trajectory, const PathQuery& query) {
  FlightPlan plan;
  for (std::size_t i = 0; i + 1 < trajectory.waypoints.size(); ++i) {
    const FlightPlan part =
        to_flight_plan(link(trajectory.waypoints[i].at, trajectory.waypoints[i + 1].at,
                            query, trajectory.waypoints[i].wait),
                       trajectory.waypoints[i].at, trajectory.times[i], query);
    plan.insert(plan.end(), part.begin(), part.end());
  }
  return plan;
}

void improve(Trajectory& trajectory, const AirspaceMap& map, SearchBudget& budget,
             double finest) {
  Improver improver(trajectory, map, budget);
  improver.leave_out();
  double step = 4 * map.query().limits.turn_radius;
  for (int i = 0; i < kMaxSweeps && step >= finest && !budget.ended(); ++i) {
    const double before = trajectory.duration();
    const bool moved = improver.move(step);
    if (!moved || before - trajectory.duration() < 1e-5 * before) {
      step /= 2;
      improver.leave_out();
    }
  }
}

}  // namespace skein::solve
