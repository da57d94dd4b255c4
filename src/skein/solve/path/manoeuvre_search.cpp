// SPDX-License-Identifier: Apache-2.0
#include "skein/solve/path/manoeuvre_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <queue>
#include <unordered_map>
#include <utility>

#include "skein/base/math.h"
#include "skein/model/path/climb_profile.h"
#include "skein/model/path/flight_plan.h"

namespace skein::solve {
namespace {

constexpr double kLargest = 8;       // step, in turn radii
constexpr double kOfRoom = 0.6;      // step, of the room
constexpr double kSame = 0.5;        // of the step: nearer states are the same
constexpr double kMaxTurn = 1.2;     // of a manoeuvre [rad]
constexpr double kPrune = 1 - 1e-4;  // what gains less is discarded
constexpr int kAncestors = 8;

struct State {
  FlightState at;
  double time;
  double step;          // [m]
  std::int32_t parent;  // -1: the start
  double wait;          // on the link from the parent [s]
};

struct Open {
  double worth;
  std::int32_t state;
  bool operator<(const Open& other) const {
    return worth != other.worth ? worth > other.worth : state > other.state;
  }
};

// North, east, altitude, heading, time and size of the cell of a state.
using Cell = std::array<std::int32_t, 6>;
struct CellHash {
  std::size_t operator()(const Cell& c) const {
    std::uint64_t h = 0x9e3779b97f4a7c15ULL;
    for (const std::int32_t x : c) {
      h ^= static_cast<std::uint32_t>(x);
      h *= 0xff51afd7ed558ccdULL;
      h ^= h >> 32;
    }
    return h;
  }
};

class Search {
 public:
  Search(const AirspaceMap& map, const SearchPass& pass, SearchBudget& budget);
  SearchResult run();

 private:
  double step_at(const FlightState& s, double time) const;
  Cell cell_of(const FlightState& s, double time, double step) const;
  void expand(std::int32_t index);
  void consider(const FlightPlan& manoeuvre, std::int32_t parent, double wait);
  FlightPlan climbing(const FlightElement& level, double rate) const;
  void smooth(State& state) const;
  void finish(std::int32_t index, const Link& to_goal);
  Trajectory trajectory_to(std::int32_t index) const;

  const AirspaceMap& map_;
  const PathQuery& query_;
  const SearchPass& pass_;
  SearchBudget& budget_;
  bool vertical_;
  Reach reach_;
  std::vector<State> states_;
  std::priority_queue<Open> open_;
  std::unordered_map<Cell, double, CellHash> cells_;
  double best_;
  SearchResult result_;
};

// Altitude is worth changing where it makes a difference.
bool needs_altitude(const PathQuery& q) {
  if (q.terrain != nullptr || q.start.p_N.z() != q.goal.p_N.z()) return true;
  if (q.airspace == nullptr) return false;
  return !q.airspace->movers.empty() || !q.airspace->flights.empty() ||
         std::any_of(q.airspace->zones.begin(), q.airspace->zones.end(),
                     [](const Zone& z) {
                       return std::isfinite(z.floor_msl) || std::isfinite(z.ceiling_msl);
                     });
}

Search::Search(const AirspaceMap& map, const SearchPass& pass, SearchBudget& budget)
    : map_(map),
      query_(map.query()),
      pass_(pass),
      budget_(budget),
      vertical_(needs_altitude(map.query())),
      reach_{query_.limits.airspeed + query_.wind.norm(),
             std::max(query_.limits.climb_rate, query_.limits.sink_rate)},
      best_(query_.start_time + pass.better) {}

double Search::step_at(const FlightState& s, double time) const {
  const double rho = query_.limits.turn_radius;
  const double room = map_.room(s.p_N, time, reach_, kLargest * rho / kOfRoom);
  return std::clamp(kOfRoom * room, pass_.finest * rho, kLargest * rho);
}

Cell Search::cell_of(const FlightState& s, double time, double step) const {
  // Cells double in size, so that near steps share them.
  const double rho = query_.limits.turn_radius;
  const int level = static_cast<int>(std::floor(math::log2(step / (pass_.finest * rho))));
  const double size = kSame * pass_.finest * rho * std::ldexp(1.0, level);
  const int headings =
      std::max(8, static_cast<int>(std::floor(2 * geo::kPi * rho / size)));
  const auto cell = [](double x, double width) {
    return static_cast<std::int32_t>(std::clamp(std::floor(x / width), -2e9, 2e9));
  };
  const Vec3 p = s.p_N - query_.start.p_N;
  const double up = size * query_.limits.climb_rate / query_.limits.airspeed;
  return {cell(p.x(), size),
          cell(p.y(), size),
          vertical_ ? cell(p.z(), up) : 0,
          cell(geo::wrap_2pi(s.heading), 2 * geo::kPi / headings),
          map_.is_timed() ? cell(time - query_.start_time, full_turn(query_)) : 0,
          level};
}

// Straight back to the ancestors, as long as that is free and quicker.
void Search::smooth(State& state) const {
  std::int32_t parent = state.parent;
  for (int i = 0; i < kAncestors; ++i) {
    const std::int32_t older = states_[static_cast<std::size_t>(parent)].parent;
    if (older < 0) return;
    const State& from = states_[static_cast<std::size_t>(older)];
    const Link l = link(from.at, state.at, query_);
    budget_.spend();
    const double time = from.time + l.duration;
    if (time > state.time + 1e-9) return;
    if (!map_.is_free(to_flight_plan(l, from.at, from.time, query_))) return;
    state.time = time;
    state.parent = older;
    state.wait = 0;
    parent = older;
  }
}

void Search::finish(std::int32_t index, const Link& to_goal) {
  const double arrival = states_[static_cast<std::size_t>(index)].time + to_goal.duration;
  if (arrival >= best_) return;
  Trajectory trajectory = trajectory_to(index);
  // Links may be quicker than the manoeuvres between the same states, and elsewhere.
  if (!map_.is_free(to_flight_plan(trajectory, query_))) return;
  best_ = std::min(arrival, trajectory.times.back());
  result_.trajectory = std::move(trajectory);
}

Trajectory Search::trajectory_to(std::int32_t index) const {
  std::vector<Waypoint> waypoints = {{query_.goal}};
  double wait = 0;
  while (index >= 0) {
    const State& s = states_[static_cast<std::size_t>(index)];
    waypoints.push_back({s.at, wait});
    wait = s.wait;
    index = s.parent;
  }
  std::reverse(waypoints.begin(), waypoints.end());
  return *make_trajectory(std::move(waypoints), query_);
}

void Search::consider(const FlightPlan& manoeuvre, std::int32_t parent, double wait) {
  budget_.spend();
  State next{state_after(manoeuvre), model::end_time_of(manoeuvre), 0, parent, wait};
  Link to_goal = link(next.at, query_.goal, query_);
  double min = min_time(to_goal, next.at, query_.goal, query_);
  if (next.time + min >= best_ * kPrune) return;
  if (!map_.is_free(manoeuvre)) return;
  smooth(next);
  next.step = step_at(next.at, next.time);
  const Cell cell = cell_of(next.at, next.time, next.step);
  const auto [known, fresh] = cells_.try_emplace(cell, next.time);
  if (!fresh) {
    if (known->second <= next.time + 1e-9) return;
    known->second = next.time;
  }
  const auto index = static_cast<std::int32_t>(states_.size());
  states_.push_back(next);
  if (next.time + to_goal.duration < best_ &&
      map_.is_free(to_flight_plan(to_goal, next.at, next.time, query_))) {
    finish(index, to_goal);
    if (is_exact(to_goal)) return;
  }
  open_.push({next.time + pass_.heuristic_weight * min, index});
}

// The manoeuvre as high as it can climb with at most a rate, beginning and ending level
// where the vertical acceleration is bounded.
FlightPlan Search::climbing(const FlightElement& level, double rate) const {
  if (rate == 0) return {level};
  const double a = query_.limits.climb_acceleration;
  const double ramp = a > 0 ? std::min(std::abs(rate) / a, level.duration / 2) : 0;
  const double reached = a > 0 ? std::copysign(a * ramp, rate) : rate;
  const double climb = reached * (level.duration - ramp);
  return model::climbing({level}, level.p_N.z(),
                         model::even_climb(climb, level.duration, a));
}

void Search::expand(std::int32_t index) {
  const State from = states_[static_cast<std::size_t>(index)];
  const FlightLimits& limits = query_.limits;
  const double turn_rate = limits.airspeed / limits.turn_radius;
  const auto manoeuvre = [&](double duration, double rate, double climb,
                             double wait = 0) {
    FlightElement e;
    e.start = from.time;
    e.duration = duration;
    e.p_N = from.at.p_N;
    e.heading = from.at.heading;
    e.airspeed = limits.airspeed;
    e.turn_rate = rate;
    e.wind = query_.wind;
    consider(climbing(e, climb), index, wait);
  };
  const double straight = from.step / limits.airspeed;
  const double turn = std::min(straight, kMaxTurn / turn_rate);
  const std::array<double, 3> climbs = {0, limits.climb_rate, -limits.sink_rate};
  for (std::size_t i = 0; i < (vertical_ ? 3 : 1); ++i) {
    manoeuvre(straight, 0, climbs[i]);
    manoeuvre(turn, turn_rate, climbs[i]);
    manoeuvre(turn, -turn_rate, climbs[i]);
  }
  const double full = full_turn(query_);
  if (map_.is_timed()) manoeuvre(full, turn_rate, 0, full);
}

SearchResult Search::run() {
  states_.push_back({query_.start, query_.start_time, 0, -1, 0});
  states_.front().step = step_at(query_.start, query_.start_time);
  const Link direct = link(query_.start, query_.goal, query_);
  open_.push({query_.start_time + direct.duration, 0});
  const std::int64_t until = budget_.expansions() + pass_.expansions;
  while (!open_.empty() && !budget_.ended() && budget_.expansions() < until) {
    if (pass_.first && result_.trajectory) return std::move(result_);
    const Open next = open_.top();
    open_.pop();
    const State& s = states_[static_cast<std::size_t>(next.state)];
    if (cells_.size() > 0 && next.state > 0) {
      const auto known = cells_.find(cell_of(s.at, s.time, s.step));
      if (known != cells_.end() && known->second < s.time - 1e-9) continue;
    }
    expand(next.state);
  }
  result_.exhausted = open_.empty();
  return std::move(result_);
}

}  // namespace

SearchResult search_manoeuvres(const AirspaceMap& map, const SearchPass& pass,
                               SearchBudget& budget) {
  return Search(map, pass, budget).run();
}

}  // namespace skein::solve
