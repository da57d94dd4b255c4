// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/trajectory/steering_flight.h"

#include <fmt/format.h>

#include <string>
#include <utility>

#include "skein/base/math.h"
#include "skein/layer/reasoning/trajectory/altitude.h"
#include "skein/model/path/wind_triangle.h"

namespace skein::reasoning {
namespace {

constexpr double kCircleReserve = 1.1;  // of turn radii over ground: room to correct
constexpr double kMovedPlace = 1;       // nearer is the same place [m]
constexpr double kWorthSaying = 100;    // another place instead is reported [m]
constexpr double kSameRoom = 0.95;      // of a circle's radius, as the wind varies

double altitude_for(const std::optional<double>& own, const FlightContext& context,
                    const NavEstimate& nav) {
  return own ? *own
             : altitude_over(*context.map, geo::horizontal(nav.p_N),
                             geo::horizontal(nav.v_N), context.altitude_agl,
                             context.limits.climb_rate);
}

}  // namespace

void steer(const Steering& intent, const FlightContext& context,
           const TrajectoryStep& step, AgentOutput& out) {
  const NavEstimate& nav = *step.in.nav;
  AutopilotCommand command;
  command.altitude_msl = altitude_for(intent.altitude_msl, context, nav);
  command.airspeed = intent.airspeed ? intent.airspeed : context.ordered_airspeed;
  command.guidance =
      step.zones.keep_out(intent.guidance, intent.course, nav, command.altitude_msl);
  out.command = std::move(command);
}

void CirclingFlight::step(const Circling& intent, const TrajectoryStep& step,
                          AgentOutput& out) {
  const NavEstimate& nav = *step.in.nav;
  const double altitude = altitude_for(intent.altitude_msl, context_, nav);
  const double radius = wide_radius(context_.limits, nav.wind_N);
  step.zones.regard(nav, altitude);
  // The place that was found stays while there is room.
  const bool known = found_ && (intent.centre - asked_).norm() < kWorthSaying &&
                     !step.zones.may_circle(intent.centre, radius) &&
                     step.zones.may_circle(*found_, kSameRoom * radius);
  std::optional<Vec2> free = found_;
  if (!known) {
    free = step.zones.place_to_circle(intent.centre, radius, nav, altitude);
    asked_ = intent.centre;
  }
  const Vec2 place = free.value_or(step.zones.allowed(intent.centre, nav, altitude));
  const bool moved = !free || (place - intent.centre).norm() > kMovedPlace;
  found_ = moved ? free : std::nullopt;
  // Of a place that moves only now and then.
  if (moved != said_.has_value() || (moved && (place - *said_).norm() > kWorthSaying)) {
    std::string text = "no zone forbids the place of the task any more";
    if (!free)
      text = "no-fly zones leave no room to circle anywhere near the place of the task";
    else if (moved)
      text = fmt::format(
          "a no-fly zone leaves no room at the place of the task: {:.0f} m "
          "north, {:.0f} m east instead",
          place.x(), place.y());
    out.events.push_back(
        {step.in.now, context_.self, EventKind::kTaskMoved, std::move(text)});
    said_ = moved ? std::optional(place) : std::nullopt;
    // Beside a zone the first turn is away from it.
    const Vec2 there = place - geo::horizontal(nav.p_N);
    clockwise_ = !moved || geo::cross(geo::horizontal(nav.v_N), there) >= 0;
  }
  Steering steering = circle_at(place, nav, context_.limits, clockwise_);
  steering.altitude_msl = altitude;
  steer(steering, context_, step, out);
}

double wide_radius(const FlightLimits& limits, const Vec2& wind) {
  return kCircleReserve *
         model::ground_turn_radius(limits.turn_radius, limits.airspeed, wind.norm());
}

Steering circle_at(const Vec2& centre, const NavEstimate& nav, const FlightLimits& limits,
                   bool clockwise) {
  const double radius = wide_radius(limits, nav.wind_N);
  const Vec2 out = geo::horizontal(nav.p_N) - centre;
  Steering steering;
  steering.guidance = Circle{centre, radius, clockwise};
  // Tangential on the circle, straight to it from afar.
  const double turned = geo::kPi / 2 + math::atan2(out.norm() - radius, radius);
  steering.course = geo::bearing(out) + (clockwise ? turned : -turned);
  return steering;
}

}  // namespace skein::reasoning
