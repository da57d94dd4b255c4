#include "model/connection/arrival.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "model/path/dubins.h"
#include "model/path/flight_plan.h"
#include "model/path/path_geometry.h"

namespace skein::model {
namespace {

constexpr double kTurn = 2 * geo::kPi;
// Looked at from 0 to a full turn, or to that much straight on.
constexpr int kSteps = 48;
constexpr int kHalvings = 60;
constexpr double kExact = 1e-10;  // of the length, in turn radii

// Everything happens in the air mass, where the goal of that time stands still.
struct Way {
  Pose from, to;
  double radius;
};

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
DubinsPath between(const Way& way, const Extra& extra) {
  return dubins(after(way.from, extra.first, extra.curvature),
                after(way.to, -extra.last, 0), way.radius);
}

double total(const Way& way, const Extra& extra) {
  return extra.first + extra.last + between(way, extra).length();
}

// One family of lengthened paths: `parameter` from 0 to 1.
using Family = Extra (*)(const Way& way, double parameter);

Extra straight_first(const Way& way, double p) {
  return {p * kTurn * way.radius, 0, 0};
}
Extra straight_last(const Way& way, double p) {
  return {0, 0, p * kTurn * way.radius};
}
Extra right_first(const Way& way, double p) {
  return {p * kTurn * way.radius, 1 / way.radius, 0};
}
Extra left_first(const Way& way, double p) {
  return {p * kTurn * way.radius, -1 / way.radius, 0};
}

// The first member of a family with exactly that length.
std::optional<Extra> member(const Way& way, Family family, double length) {
  const double exact = kExact * way.radius;
  double low = 0;
  if (std::abs(total(way, {}) - length) <= exact) return Extra{};
  for (int i = 1; i <= kSteps; ++i) {
    const double high = static_cast<double>(i) / kSteps;
    const double at_low = total(way, family(way, low)) - length;
    const double at_high = total(way, family(way, high)) - length;
    if ((at_low < 0) != (at_high < 0)) {
      double a = low, b = high;
      for (int k = 0; k < kHalvings; ++k) {
        const double middle = (a + b) / 2;
        ((total(way, family(way, middle)) - length < 0) == (at_low < 0) ? a : b) = middle;
      }
      // Where the shortest length jumps there is none.
      for (const double p : {a, b})
        if (std::abs(total(way, family(way, p)) - length) <= exact) return family(way, p);
    }
    low = high;
  }
  return std::nullopt;
}

class PlanBuilder {
 public:
  PlanBuilder(const Pose& from, const AirMotion& air) : air_(air) {
    next_.p_N = {from.position.x(), from.position.y(), 0};
    next_.heading = from.course;
    next_.airspeed = air.airspeed;
    next_.wind = air.wind;
  }
  // Flies `length` of air [m].
  void fly(double length, double curvature) {
    if (length <= 0) return;
    next_.duration = length / air_.airspeed;
    next_.turn_rate = curvature * air_.airspeed;
    plan_.push_back(next_);
    const FlightMoment end = end_of(next_);
    next_.start += next_.duration;
    next_.p_N = end.p_N;
    next_.heading = end.heading;
  }
  FlightPlan take() { return std::move(plan_); }

 private:
  const AirMotion& air_;
  FlightElement next_;
  FlightPlan plan_;
};

FlightPlan build(const Way& way, const Extra& extra, int loops, const AirMotion& air) {
  const DubinsPath path = between(way, extra);
  const std::array<int, 3> sides = sides_of(path.word);
  PlanBuilder plan(way.from, air);
  // The circles turn as what follows them does.
  const double side =
      extra.first > 0 && extra.curvature != 0 ? extra.curvature * way.radius : sides[0];
  plan.fly(loops * kTurn * way.radius, side / way.radius);
  plan.fly(extra.first, extra.curvature);
  for (std::size_t i = 0; i < 3; ++i)
    plan.fly(path.parts[i] * way.radius, sides[i] / way.radius);
  plan.fly(extra.last, 0);
  return plan.take();
}

}  // namespace

Arrival connect_at(const Pose& from, const Pose& to, const AirMotion& air, double time) {
  Arrival arrival;
  const Connection direct = connect(from, to, air);
  if (direct.status != ConnectionStatus::kFound || !std::isfinite(time)) return arrival;
  arrival.earliest = direct.time;
  const Way way{from, {to.position - time * air.wind, to.course}, air.turn_radius};
  const double length = time * air.airspeed, least = total(way, {});
  const double exact = kExact * air.turn_radius;
  if (length < least - exact) {
    // Before the earliest meeting, or where the shortest length has jumped up since.
    arrival.status = time < direct.time ? ArrivalStatus::kTooEarly : ArrivalStatus::kGap;
    return arrival;
  }
  const double circle = kTurn * air.turn_radius;
  const int loops =
      std::max(0, static_cast<int>(std::floor((length - least + exact) / circle)));
  // A circle less leaves more room where a family has a gap.
  for (int fewer = 0; fewer <= std::min(1, loops); ++fewer) {
    const double rest = length - (loops - fewer) * circle;
    for (const Family family : {straight_first, straight_last, right_first, left_first})
      if (const auto extra = member(way, family, rest)) {
        arrival.status = ArrivalStatus::kFound;
        arrival.plan = build(way, *extra, loops - fewer, air);
        return arrival;
      }
  }
  arrival.status = ArrivalStatus::kGap;
  return arrival;
}

}  // namespace skein::model
