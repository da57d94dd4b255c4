// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "skein/data/vehicle/vehicle_request.h"
#include "skein/link/mavlink/constants.h"
#include "skein/link/vehicle_services/vehicle_snapshot.h"

namespace skein::vehicle_services {

/// A mode that simulated vehicles have, as a make calls it. What all numbers of a make
/// mean is in skein/link/mavlink/flight_modes.h.
struct ModeRow {
  VehicleMode mode = VehicleMode::kOther;
  std::uint32_t number = 0;  ///< of heartbeats (custom_mode)
  std::string_view name;
  bool selectable = true;  ///< ground stations may set it
  mavlink::StandardMode standard = mavlink::StandardMode::kNone;
};

/// The modes of a make and airframe. Several rows may mean the same; the first of a mode
/// is how it is shown unless another was asked for.
std::span<const ModeRow> modes_of(Make make, bool hovers);

/// How a mode is shown.
const ModeRow& row_of(VehicleMode mode, Make make, bool hovers);

/// The first row with a number; null without one.
const ModeRow* find_mode(std::uint32_t number, Make make, bool hovers);

/// How guided flight to a place is shown.
const ModeRow& row_of_place(Make make, bool hovers);

/// PX4's number of a mode.
constexpr std::uint32_t px4_mode(std::uint32_t main, std::uint32_t sub = 0) {
  return main << 16 | sub << 24;
}
inline constexpr std::uint32_t kPx4Hold = px4_mode(4, 3);
inline constexpr std::uint32_t kPx4Offboard = px4_mode(6);

/// Flags of a heartbeat (base_mode) for a mode, without that of arming.
std::uint8_t mode_flags_of(VehicleMode mode);

}  // namespace skein::vehicle_services
