// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "skein/geo/vec.h"

namespace skein::autopilot {

// What guidance asks of control.

enum class FlightPhase : std::uint8_t {
  kGround,    ///< at rest, motors off
  kRun,       ///< take-off run: wings level, full power, along the heading
  kClimbOut,  ///< after take-off: full power, best climb
  kFlight,
  kApproach,  ///< down the glide slope
  kFlare,     ///< wings level, by sink rate, touching down; no airspeed: motor idle
  kRollOut,   ///< after touch-down: nose down, wings level, along the course, braking
  kGlide,     ///< without motor: altitude is traded for airspeed
};

/// For a fixed wing.
struct FixedWingDemand {
  double lateral_acceleration = 0;  ///< across the ground track, right positive [m/s^2]
  double altitude_msl = 0;          ///< [m]
  double climb_rate = 0;  ///< at which the demanded altitude changes [m/s], up positive
  double airspeed = 0;    ///< [m/s]
  FlightPhase phase = FlightPhase::kFlight;
  /// Unit vector that the nose is to point along just before the touch, with idle motor,
  /// and in the roll-out; zero: along the velocity through the air.
  Vec2 heading = Vec2::Zero();
  double braking = 0;  ///< deceleration of the roll-out over ground [m/s^2]
};

/// For a multirotor: a reference that moves.
struct MultirotorDemand {
  Vec2 position = Vec2::Zero();      ///< [m]; counts when holds_position
  Vec2 velocity = Vec2::Zero();      ///< of the reference over ground [m/s]
  Vec2 acceleration = Vec2::Zero();  ///< of the reference [m/s^2]
  bool holds_position = true;        ///< false: only the velocity counts
  double altitude_msl = 0;           ///< [m]
  double climb_rate = 0;             ///< at which the demanded altitude changes [m/s]
  double heading = 0;                ///< [rad]
  FlightPhase phase = FlightPhase::kFlight;
};

/// From a pilot's sticks, or for tests: the inner loops alone.
struct AttitudeDemand {
  double roll = 0;      ///< [rad]
  double pitch = 0;     ///< [rad]
  double yaw_rate = 0;  ///< [rad/s]
  double throttle = 0;  ///< 0 to 1
};

}  // namespace skein::autopilot
