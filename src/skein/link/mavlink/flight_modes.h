// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "skein/data/vehicle/vehicle_request.h"

/// What the numbers of modes in HEARTBEAT mean, which depends on the make of autopilot
/// and on the airframe. Facts of ArduPilot 4.5 and PX4 1.14.
namespace skein::mavlink {

enum class Make : std::uint8_t { kArduPilot, kPx4, kOther };

/// Makes by MAV_AUTOPILOT.
inline constexpr std::uint8_t kAutopilotGeneric = 0;
inline constexpr std::uint8_t kAutopilotArduPilot = 3;
inline constexpr std::uint8_t kAutopilotInvalid = 8;
inline constexpr std::uint8_t kAutopilotPx4 = 12;

constexpr Make make_of(std::uint8_t autopilot) {
  if (autopilot == kAutopilotArduPilot) return Make::kArduPilot;
  if (autopilot == kAutopilotPx4) return Make::kPx4;
  return Make::kOther;
}

/// Flags of base_mode.
inline constexpr std::uint8_t kModeArmed = 0x80;
inline constexpr std::uint8_t kModeManualInput = 0x40;
inline constexpr std::uint8_t kModeHil = 0x20;
inline constexpr std::uint8_t kModeStabilized = 0x10;
inline constexpr std::uint8_t kModeGuided = 0x08;
inline constexpr std::uint8_t kModeAuto = 0x04;
inline constexpr std::uint8_t kModeCustom = 0x01;

/// The mode that a number stands for; kOther for those that have no counterpart.
/// @param hovers  a multirotor; else a fixed wing.
VehicleMode mode_of(Make make, bool hovers, std::uint32_t custom_mode);

/// As pilots of that make call it: "GUIDED", "AUTO.MISSION"; its number for others.
std::string mode_name(Make make, bool hovers, std::uint32_t custom_mode);

/// The number of a mode; none when the make has no such mode.
std::optional<std::uint32_t> custom_mode_of(Make make, bool hovers, VehicleMode mode);

}  // namespace skein::mavlink
