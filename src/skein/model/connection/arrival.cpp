// SPDX-License-Identifier: Apache-2.0
#include "skein/model/connection/arrival.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "skein/model/connection/plan_builder.h"
#include "skein/model/path/dubins.h"
#include "skein/model/path/path_geometry.h"

namespace skein::model {
namespace {

constexpr double kTurn = 2 * geo::kPi;
// Looked at from 0 to a full turn, or to that much straight on.
constexpr int kSteps = 48;
constexpr int kMaxSteps = 60;  // of false position
// Lengths are met to this, in turn radii, and to this share of them.
constexpr double kExact = 1e-10, kRounding = 1e-14;
constexpr double kLongest = 1e9;  // flight, in turn radii

// Everything happens in the air mass, where the goal of that time stands still.
struct Task {
  Pose from, to;
  double radius;
};

double exact_of(const Task& task, double length) {
  return kExact * task.radius + kRounding * length;
}

// What is flown besides the shortest connection: first a turn or straight, before the end
// a straight.
struct Extra {
  double first = 0;      // length [m]
  double curvature = 0;  // of the first [1/m], right positive
  double last = 0;       // straight [m]
};

Pose after(const Pose& pose, double length, double curvature) {
  return pose_at(PathElement{pose.position, pose.course, length, curvature}, length);
}

// The connection between what is flown before and after it.
DubinsPath between(const Task& task, const Extra& extra) {
  return dubins(after(task.from, extra.first, extra.curvature),
                after(task.to, -extra.last, 0), task.radius);
}

double total(const Task& task, const Extra& extra) {
  return extra.first + extra.last + between(task, extra).length();
}

// One family of lengthened paths: `parameter` from 0 to 1.
using Family = Extra (*)(const Task& task, double parameter);

Extra straight_first(const Task& task, double p) {
  return {p * kTurn * task.radius, 0, 0};
}
Extra straight_last(const Task& task, double p) {
  return {0, 0, p * kTurn * task.radius};
}
Extra right_first(const Task& task, double p) {
  return {p * kTurn * task.radius, 1 / task.radius, 0};
}
Extra left_first(const Task& task, double p) {
  return {p * kTurn * task.radius, -1 / task.radius, 0};
}

// Where a family's length crosses the requested one between two parameters: false
// position, with the weight of an end that stays halved (Illinois). Nothing where the
// shortest length jumps.
std::optional<Extra> crossing(const Task& task, Family family, double length, double a,
                              double at_a, double b, double at_b) {
  const double exact = exact_of(task, length);
  for (int i = 0; i < kMaxSteps; ++i) {
    const double p = i % 8 == 7 ? (a + b) / 2 : a - at_a * (b - a) / (at_b - at_a);
    const double at_p = total(task, family(task, p)) - length;
    if (std::abs(at_p) <= exact) return family(task, p);
    if ((at_p < 0) == (at_b < 0)) {
      b = p;
      at_b = at_p;
      at_a /= 2;
    } else {
      a = b;
      at_a = at_b;
      b = p;
      at_b = at_p;
    }
  }
  return std::nullopt;
}

// The first member of a family with exactly that length.
std::optional<Extra> member(const Task& task, Family family, double length) {
  double low = 0, at_low = total(task, {}) - length;
  if (std::abs(at_low) <= exact_of(task, length)) return Extra{};
  for (int i = 1; i <= kSteps; ++i) {
    const double high = static_cast<double>(i) / kSteps;
    const double at_high = total(task, family(task, high)) - length;
    if ((at_low < 0) != (at_high < 0))
      if (auto extra = crossing(task, family, length, low, at_low, high, at_high))
        return extra;
    low = high;
    at_low = at_high;
  }
  return std::nullopt;
}

FlightPlan build(const Task& task, const Extra& extra, int loops, const AirMotion& air) {
  const DubinsPath path = between(task, extra);
  const std::array<int, 3> sides = sides_of(path.word);
  PlanBuilder plan(task.from, air);
  // The circles turn as what follows them does.
  const double first_side = extra.curvature * task.radius;
  plan.fly(loops * kTurn, first_side != 0 ? first_side : sides[0]);
  plan.fly(extra.first / task.radius, first_side);
  for (std::size_t i = 0; i < 3; ++i) plan.fly(path.parts[i], sides[i]);
  plan.fly(extra.last / task.radius, 0);
  return plan.take();
}

}  // namespace

Arrival connect_at(const Pose& from, const Pose& to, const AirMotion& air, double time) {
  Arrival arrival;
  const Connection direct = connect(from, to, air);
  if (direct.status != ConnectionStatus::kFound) return arrival;
  if (!(std::abs(time) * air.airspeed <= kLongest * air.turn_radius)) return arrival;
  arrival.earliest = direct.time;
  const Task task{from, {to.position - time * air.wind, to.course}, air.turn_radius};
  const double length = time * air.airspeed, min = total(task, {});
  const double exact = exact_of(task, length);
  if (length < min - exact) {
    // Before the earliest meeting, or where the shortest length has jumped up since.
    arrival.status = time < direct.time ? ArrivalStatus::kTooEarly : ArrivalStatus::kGap;
    return arrival;
  }
  const double circle = kTurn * air.turn_radius;
  const int loops =
      std::max(0, static_cast<int>(std::floor((length - min + exact) / circle)));
  // A circle less leaves more room where a family has a gap.
  for (int fewer = 0; fewer <= std::min(1, loops); ++fewer) {
    const double rest = length - (loops - fewer) * circle;
    for (const Family family : {straight_first, straight_last, right_first, left_first})
      if (const auto extra = member(task, family, rest)) {
        arrival.status = ArrivalStatus::kFound;
        arrival.plan = build(task, *extra, loops - fewer, air);
        return arrival;
      }
  }
  arrival.status = ArrivalStatus::kGap;
  return arrival;
}

}  // namespace skein::model
