// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>

#include "skein/base/time.h"
#include "skein/data/describe/describe.h"
#include "skein/data/vehicle/control.h"
#include "skein/geo/rotation.h"
#include "skein/geo/vec.h"

namespace skein {

/// What a vehicle has to fly with, and uses.
struct Energy {
  double charge = 1;   ///< of the battery or tank, left, from 0 to 1
  double voltage = 0;  ///< at the battery, under load [V]; 0 = not modelled
  double power = 0;    ///< drawn now [W]; 0 = not modelled
};

constexpr auto describe(const Energy*) {
  using T = Energy;
  return described<T>(
      {"energy"}, "What a vehicle has to fly with, and uses.",
      field("charge", &T::charge, "left, from 0 to 1"),
      field("voltage", &T::voltage, unit::kVolt, "under load; 0: not modelled"),
      field("power", &T::power, unit::kWatt, "drawn now; 0: not modelled"));
}

/// Which parts of a vehicle do not work.
struct Faults {
  std::uint8_t dead =
      0;  ///< bit k: actuator k gives nothing (motor stands, surface flutters)
  std::uint8_t stuck = 0;  ///< bit k: actuator k stays where it is
  bool battery = false;    ///< the battery gives nothing any more

  bool is_dead(std::size_t k) const { return (dead >> k & 1u) != 0; }
  bool is_stuck(std::size_t k) const { return (stuck >> k & 1u) != 0; }
};

constexpr auto describe(const Faults*) {
  using T = Faults;
  return described<T>(
      {"faults"}, "Which parts of a vehicle do not work.",
      field("dead_actuators", &T::dead, "bit k: actuator k gives nothing"),
      field("stuck_actuators", &T::stuck, "bit k: actuator k is stuck"),
      field("battery_failed", &T::battery, "it gives nothing any more"));
}

/// The true motion of a vehicle and of what moves it. N is the local frame with its
/// origin at mean sea level, so the altitude above mean sea level is -p_N.z().
struct VehicleState {
  Vec3 p_N = Vec3::Zero();       ///< position [m]
  Vec3 v_N = Vec3::Zero();       ///< velocity over ground [m/s]
  Quat q_NB = Quat::Identity();  ///< attitude; without side-slip its yaw is the heading
  Vec3 w_NB_B = Vec3::Zero();    ///< rate of turn [rad/s]
  double airspeed = 0;           ///< [m/s]
  std::array<double, Actuators::kMaxChannels>
      actuators{};  ///< what they do now; see the plant
  Energy energy;
  Faults faults;
  bool on_ground = false;
  bool held = false;  ///< by its crew, before the start
};

constexpr auto describe(const VehicleState*) {
  using T = VehicleState;
  return described<T>(
      {"vehicle_state"}, "The true motion of a vehicle and of what moves it.",
      field("", &T::p_N, axes::kPlace, "position"),
      field("", &T::v_N, axes::kVelocity, "over ground"),
      field("", &T::q_NB, "attitude; the heading is that of the forward axis"),
      untabled(field("", &T::w_NB_B, axes::kBodyRates, "rates of turn")),
      field("airspeed", &T::airspeed, unit::kMetrePerSecond, "through the air"),
      untabled(field("actuator", &T::actuators, "what they do; see the plant")),
      field("", &T::energy, "what it flies with"),
      untabled(field("", &T::faults, "what does not work")),
      field("on_ground", &T::on_ground, "it stands or rolls"),
      untabled(field("held", &T::held, "by its crew, before the start")));
}

/// The change of the climb rate that plans are made with for aircraft that have a mass: a
/// tenth of their weight more or less to be carried [m/s^2].
inline constexpr double kClimbAcceleration = 1;

/// What a vehicle can do, as planners need it.
struct FlightLimits {
  double airspeed = 20;     ///< cruise [m/s]
  double turn_radius = 60;  ///< smallest, in the air mass at cruise airspeed [m]
  double climb_rate = 3;    ///< largest [m/s]
  double slowest = 15;      ///< minimum airspeed in level flight [m/s]; 0 = it can hover
  double fastest = 25;      ///< [m/s]
  double sink_rate = 3;     ///< largest [m/s]
  /// Thinnest air that it can fly level in [kg/m^3]; 0 = it flies in any.
  double min_density = 0;
  /// Largest change of the climb rate that plans are made with [m/s^2]; 0: it changes at
  /// once.
  double climb_acceleration = 0;
};

constexpr auto describe(const FlightLimits*) {
  using T = FlightLimits;
  return described<T>(
      {"flight_limits"}, "What a vehicle can do.",
      field("airspeed", &T::airspeed, unit::kMetrePerSecond, "cruise"),
      field("turn_radius", &T::turn_radius, unit::kMetre, "smallest, at cruise"),
      field("climb_rate", &T::climb_rate, unit::kMetrePerSecond, "largest"),
      field("slowest", &T::slowest, unit::kMetrePerSecond, "level flight; 0: it hovers"),
      field("fastest", &T::fastest, unit::kMetrePerSecond, "level flight"),
      field("sink_rate", &T::sink_rate, unit::kMetrePerSecond, "largest"),
      field("min_density", &T::min_density, unit::kKilogramPerCubicMetre,
            "of air that carries it; 0: any"),
      field("climb_acceleration", &T::climb_acceleration, unit::kMetrePerSecondSquared,
            "largest in plans; 0: climbs begin at once"));
}

/// What an autopilot's estimator believes about its own vehicle.
struct NavEstimate {
  Time time;
  Vec3 p_N = Vec3::Zero();
  Vec3 v_N = Vec3::Zero();
  double heading = 0;          ///< of the air-relative velocity [rad]
  Vec2 wind_N = Vec2::Zero();  ///< estimated horizontal wind [m/s]
  double position_sd = 0;      ///< per horizontal axis [m]
  double roll = 0;             ///< [rad]
  double pitch = 0;            ///< [rad]
  double altitude_sd = 0;      ///< [m]
};

constexpr auto describe(const NavEstimate*) {
  using T = NavEstimate;
  return described<T>(
      {"nav"}, "What an estimator believes about its own vehicle.",
      field("time", &T::time, "that it is of"),
      field("", &T::p_N, axes::kPlace, "position"),
      field("", &T::v_N, axes::kVelocity, "over ground"),
      field("heading", &T::heading, unit::kDegree, "of the air-relative velocity"),
      field("", &T::wind_N, axes::kWind, "estimated, horizontal"),
      field("position_sd", &T::position_sd, unit::kMetre, "per horizontal axis"),
      field("roll", &T::roll, unit::kDegree, "right wing down positive"),
      field("pitch", &T::pitch, unit::kDegree, "nose up positive"),
      field("altitude_sd", &T::altitude_sd, unit::kMetre, "of the altitude"));
}

/// The true motion as an estimate without errors: what an operator gives an autopilot at
/// the start. The wind is not known.
inline NavEstimate as_estimate(const VehicleState& state, Time time) {
  const geo::Euler attitude = geo::to_euler(state.q_NB);
  NavEstimate nav;
  nav.time = time;
  nav.p_N = state.p_N;
  nav.v_N = state.v_N;
  nav.heading = attitude.yaw;
  nav.roll = attitude.roll;
  nav.pitch = attitude.pitch;
  return nav;
}

}  // namespace skein
