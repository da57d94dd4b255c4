// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "skein/link/vehicle_services/command.h"
#include "skein/link/vehicle_services/pilot_override.h"
#include "skein/link/vehicle_services/served_vehicle.h"

// What is asked of a vehicle as a whole: arming, modes, take-off, landing, its mission.
// Each is judged, requested of the simulation, and answered.

namespace skein::vehicle_services {

/// Arms or disarms. In flight it is disarmed only by force.
Answer arm(ServedVehicle& vehicle, bool arm, bool force);

/// Puts it into a mode by its number.
Answer set_mode(ServedVehicle& vehicle, PilotOverride& pilot, std::uint32_t number);
Answer set_mode(ServedVehicle& vehicle, PilotOverride& pilot, const ModeRow& row);

/// @param altitude_msl  none: as high above home as the parameter says.
/// On the ground before arming, a vehicle of ArduPilot's make refuses; one of PX4's takes
/// off when it is armed.
Answer take_off(ServedVehicle& vehicle, PilotOverride& pilot,
                std::optional<double> altitude_msl, std::optional<double> course);

/// @param point  none: where it is.
Answer land(ServedVehicle& vehicle, PilotOverride& pilot, std::optional<Vec2> point,
            std::optional<double> ground_msl, std::optional<double> course);

/// Flies the stored mission from an item on, counted from 0.
Answer start_mission(ServedVehicle& vehicle, PilotOverride& pilot, std::uint16_t item);

/// Makes an item the present one; the mission is not begun by that.
Answer select_item(ServedVehicle& vehicle, std::uint16_t item);

/// Changes the airspeed [m/s].
Answer change_speed(ServedVehicle& vehicle, double airspeed);

}  // namespace skein::vehicle_services
