// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "skein/data/describe/describe.h"
#include "skein/geo/vec.h"

namespace skein {

/// One piece of a flight through air that moves evenly: constant airspeed, turn rate,
/// vertical acceleration and wind. Seen from the air mass it is a straight line, a circle
/// or a helix, seen from the ground a turn is a trochoid; with a vertical acceleration, a
/// *vertical turn*, its altitude is a parabola over time. Its motion in closed form is in
/// model/path/flight_plan.h.
struct FlightElement {
  double start = 0;               ///< time at which it begins, on the run's clock [s]
  double duration = 0;            ///< [s]
  Vec3 p_N = Vec3::Zero();        ///< position at the start [m]
  double heading = 0;             ///< at the start, of the air-relative velocity [rad]
  double airspeed = 0;            ///< horizontal part [m/s]
  double turn_rate = 0;           ///< positive turns right, 0 is straight [rad/s]
  double climb_rate = 0;          ///< at the start, upwards [m/s]
  Vec2 wind = Vec2::Zero();       ///< velocity of the air over ground [m/s]
  double climb_acceleration = 0;  ///< change of the climb rate, upwards [m/s^2]
};

constexpr auto describe(const FlightElement*) {
  using T = FlightElement;
  return described<T>(
      {"flight_element"}, "One piece of a flight through air that moves evenly.",
      field("start", &T::start, unit::kSecond, "when it begins"),
      field("duration", &T::duration, unit::kSecond, "how long it lasts"),
      field("", &T::p_N, axes::kPlace, "where it begins"),
      field("heading", &T::heading, unit::kDegree, "at the start, through the air"),
      field("airspeed", &T::airspeed, unit::kMetrePerSecond, "horizontal"),
      field("turn_rate", &T::turn_rate, unit::kDegreePerSecond, "right positive"),
      field("climb_rate", &T::climb_rate, unit::kMetrePerSecond, "at the start, upwards"),
      field("", &T::wind, axes::kWind, "that it was planned in"),
      field("climb_acceleration", &T::climb_acceleration, unit::kMetrePerSecondSquared,
            "change of the climb rate, upwards"));
}

/// A flight in space and time: elements that join in time, position and heading. An empty
/// plan is no flight.
using FlightPlan = std::vector<FlightElement>;

/// A place in space with a heading of the air-relative velocity.
struct FlightState {
  Vec3 p_N = Vec3::Zero();  ///< [m]
  double heading = 0;       ///< [rad]
};

}  // namespace skein
