// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <variant>

#include "skein/data/vehicle/setpoint.h"

namespace skein {

/// What an autopilot asks of a plant that holds its own attitude.
struct FlightCommand {
  double roll = 0;        ///< [rad]
  double airspeed = 0;    ///< [m/s]
  double climb_rate = 0;  ///< [m/s], up positive
};

/// What an autopilot commands the actuators of an airframe, one number a channel:
/// surfaces from -1 to 1 of their largest deflection, motors from 0 to 1. What a channel
/// moves is the airframe's business; see Channel for fixed wings. Channel k of a
/// multirotor is its rotor k.
struct Actuators {
  static constexpr std::size_t kMaxChannels = 8;
  std::array<double, kMaxChannels> channel{};

  double& operator[](std::size_t k) { return channel[k]; }
  double operator[](std::size_t k) const { return channel[k]; }
};

/// Channels of a fixed wing. Positive: aileron rolls right, elevator pitches down (its
/// trailing edge goes down), rudder yaws left (its trailing edge goes left).
namespace channel {
inline constexpr std::size_t kAileron = 0;
inline constexpr std::size_t kElevator = 1;
inline constexpr std::size_t kRudder = 2;
inline constexpr std::size_t kThrottle = 3;
inline constexpr std::size_t kBrake = 4;  ///< of the wheels, from 0 to 1
}  // namespace channel

/// What goes from an autopilot to its plant. A TrackSetpoint is for a vehicle whose own
/// autopilot flies trajectories; no plant takes it.
using Control = std::variant<FlightCommand, Actuators, TrackSetpoint>;

}  // namespace skein
