// SPDX-License-Identifier: Apache-2.0
#include "skein/solve/touring/patrol.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "skein/model/path/flight_plan.h"
#include "skein/solve/path/join.h"
#include "skein/solve/path/limits_check.h"
#include "skein/solve/target/arrival_order.h"
#include "skein/solve/touring/patrol_course.h"

namespace skein::solve {
namespace {

constexpr std::size_t kMaxPoints = 10'000;
constexpr int kMaxPasses = 10'000;
constexpr double kMaxLegs = 1e5;  // flown by one aircraft

PatrolResult refused(PatrolOutcome outcome, std::string reason) {
  PatrolResult result;
  result.outcome = outcome;
  result.reason = std::move(reason);
  return result;
}

std::string line_error(const PatrolQuery& q) {
  const std::size_t min = q.closed ? 3 : 2;
  if (q.line.size() < min || q.line.size() > kMaxPoints)
    return fmt::format("the line has {} points; {} to {} are allowed", q.line.size(), min,
                       kMaxPoints);
  for (std::size_t k = 0; k < q.line.size(); ++k)
    if (!on_map(q.line[k]))
      return fmt::format("point {} of the line is not a place within {:.0f} km", k,
                         kMaxCoordinate / 1000);
  for (std::size_t k = 0; k + (q.closed ? 0 : 1) < q.line.size(); ++k)
    if ((q.line[(k + 1) % q.line.size()] - q.line[k]).norm() < 1e-3)
      return fmt::format("points {} and {} of the line are at one place", k,
                         (k + 1) % q.line.size());
  return {};
}

std::string patrol_error(const PatrolQuery& q) {
  if (!(std::abs(q.offset) <= kMaxCoordinate)) return "the offset is not a usable number";
  if (!(q.tolerance > 0) || !std::isfinite(q.tolerance))
    return "the tolerance must be above 0";
  if (q.rounds < 1 || q.rounds > kMaxPasses / 2)
    return fmt::format("{} rounds; 1 to {} are allowed", q.rounds, kMaxPasses / 2);
  if (q.until && !usable_time(*q.until)) return "the end of the patrol is not a number";
  if (!usable_time(q.start_time) || !(std::abs(q.altitude_msl) <= kMaxCoordinate))
    return "start time and altitude must be numbers, and not absurd";
  return {};
}

std::string aircraft_error(const PatrolQuery& q) {
  if (q.starts.empty() || q.starts.size() > 64) return "1 to 64 aircraft are allowed";
  if (std::string error = limits_error(q.limits); !error.empty()) return error;
  if (std::string error = speeds_error(q.limits); !error.empty()) return error;
  if (!q.wind.allFinite()) return "the wind is not a number";
  for (std::size_t k = 0; k < q.starts.size(); ++k) {
    const FlightState& s = q.starts[k];
    if (std::string error = state_error(s); !error.empty())
      return fmt::format("start {}: {}", k, error);
    if (std::string error = climb_error(s.p_N.z() + q.altitude_msl, q.limits);
        !error.empty())
      return fmt::format("start {}: {}", k, error);
  }
  return {};
}

std::optional<PatrolResult> checked(const PatrolQuery& q) {
  if (auto error = line_error(q); !error.empty())
    return refused(PatrolOutcome::kBadLine, std::move(error));
  if (auto error = patrol_error(q); !error.empty())
    return refused(PatrolOutcome::kBadPatrol, std::move(error));
  if (auto error = aircraft_error(q); !error.empty())
    return refused(PatrolOutcome::kBadAircraft, std::move(error));
  if (too_windy(q.wind.norm(), q.limits.airspeed))
    return refused(PatrolOutcome::kWindTooStrong,
                   too_strong(q.wind.norm(), q.limits.airspeed));
  return std::nullopt;
}

struct Begin {
  PatrolCourse course;
  Arrivals arrivals;
  double round_time = 0, pass_time = 0, interval = 0;
};

Begin begun(const PatrolQuery& q, const std::vector<Vec2>& line, double offset) {
  const model::AirMotion air = motion_of(q.limits, q.wind);
  Begin b;
  b.course = course_of(q, line, offset, air);
  b.pass_time = model::duration(along(b.course, 1, air, 0, 0));
  b.round_time = b.pass_time;
  // There and back, and the turn that closes the round.
  if (!q.closed)
    b.round_time =
        model::duration(along(b.course, 2, air, 0, 0)) + b.course.turns.back().time;
  b.interval = b.round_time / static_cast<double>(q.starts.size());
  const model::Pose pose = begin_of(b.course, air);
  const FlightState goal{{pose.position.x(), pose.position.y(), -q.altitude_msl},
                         pose.course};
  std::vector<TimedLeg> legs;
  for (const FlightState& start : q.starts)
    legs.push_back({start, goal, q.start_time, q.limits, q.wind, true});
  b.arrivals = arrive_in_order(legs, std::nullopt, b.interval);
  return b;
}

// The end of the line that is reached first.
Begin best_begin(const PatrolQuery& q) {
  Begin best = begun(q, q.line, q.offset);
  if (q.closed) return best;
  Begin other = begun(q, {q.line.rbegin(), q.line.rend()}, -q.offset);
  return other.arrivals.earliest < best.arrivals.earliest - 1e-9 ? other : best;
}

// Passes that end by `until` when the first one begins at `begin`.
int passes_until(const PatrolQuery& q, const Begin& b, double begin) {
  if (!q.until) return q.closed ? q.rounds : 2 * q.rounds;
  const model::AirMotion air = motion_of(q.limits, q.wind);
  const double time = *q.until - begin + 1e-9;
  if (q.closed)
    return static_cast<int>(std::clamp(std::floor(time / b.round_time), 0.0,
                                       static_cast<double>(kMaxPasses)));
  const double rounds =
      std::clamp(std::floor(time / b.round_time), 0.0, kMaxPasses / 2.0);
  int passes = 2 * static_cast<int>(rounds);
  // The last round may end before its turn, or after one pass.
  for (const int more : {2, 1})
    if (time - rounds * b.round_time >= model::duration(along(b.course, more, air, 0, 0)))
      return passes + more;
  return passes;
}

}  // namespace

std::string_view name_of(PatrolOutcome outcome) {
  constexpr std::array<std::string_view, 6> kNames = {
      "planned", "no-time", "bad-line", "bad-patrol", "bad-aircraft", "wind-too-strong"};
  return kNames[static_cast<std::size_t>(outcome)];
}

PatrolResult plan_patrol(const PatrolQuery& query) {
  if (auto bad = checked(query)) return std::move(*bad);
  const model::AirMotion air = motion_of(query.limits, query.wind);
  const Begin b = best_begin(query);
  PatrolResult result;
  result.outcome = PatrolOutcome::kPlanned;
  result.round_time = b.round_time;
  result.interval = b.interval;
  result.largest_deviation = b.course.deviation;
  result.flown_over = b.course.flown_over;
  result.begins = b.arrivals.times;
  if (b.arrivals.status != TimedStatus::kFound)
    return refused(PatrolOutcome::kBadAircraft, "no path to the line was found");
  result.first_end =
      *std::min_element(result.begins.begin(), result.begins.end()) + b.pass_time;
  int max = 0;
  for (std::size_t k = 0; k < query.starts.size(); ++k) {
    const int passes = passes_until(query, b, result.begins[k]);
    if (static_cast<double>(passes) * b.course.legs_of_pass > kMaxLegs)
      return refused(PatrolOutcome::kBadPatrol,
                     fmt::format("{} passes of {} legs; fewer rounds or an earlier end",
                                 passes, b.course.legs_of_pass));
    max = std::max(max, passes);
    result.passes.push_back(passes);
    FlightPlan plan;
    if (passes > 0) {
      plan = b.arrivals.flights[k].plan;
      const FlightPlan there =
          along(b.course, passes, air, result.begins[k], -query.altitude_msl);
      plan.insert(plan.end(), there.begin(), there.end());
    }
    result.plans.push_back(std::move(plan));
  }
  if (max == 0) {
    result.outcome = PatrolOutcome::kNoTime;
    result.reason =
        fmt::format("no pass ends by {:.1f} s; the first one would at {:.1f} s",
                    *query.until, result.first_end);
  }
  return result;
}

}  // namespace skein::solve
