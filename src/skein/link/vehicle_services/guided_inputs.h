// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "skein/link/mavlink/messages.h"
#include "skein/link/vehicle_services/command.h"
#include "skein/link/vehicle_services/served_vehicle.h"

// What guided flight is sent: places, setpoints of trajectories, banks, altitudes and
// headings. Streams of setpoints count only while the vehicle is armed and guided, and
// are passed over silently otherwise.

namespace skein::vehicle_services {

/// Why guided flight is not possible now, for people; empty: it is.
std::string why_not_guided(const ServedVehicle& vehicle);

/// Flies to a place and stays there. The same place again is not asked for again.
Answer fly_to(ServedVehicle& vehicle, const FlyToRequest& request);

/// What a place is flown to with when nothing is said about it.
FlyToRequest default_fly_to(const ServedVehicle& vehicle, const Vec3& p_N);

/// Changes the altitude, wherever it flies.
/// @param climb_rate  on the way there [m/s]; 0: its own.
Answer change_altitude(ServedVehicle& vehicle, double altitude_msl, double climb_rate);

/// Keeps a heading, or a course over ground [rad].
Answer keep_heading(ServedVehicle& vehicle, double heading, bool over_ground);

/// By what a setpoint leaves out (type_mask): a place alone is flown to, as by fly_to();
/// an altitude alone is changed; with a velocity it is a TrackSetpoint, from where the
/// vehicle is where no place is given.
void handle(const mavlink::SetPositionTargetGlobalInt& setpoint, ServedVehicle& vehicle);
void handle(const mavlink::SetPositionTargetLocalNed& setpoint, ServedVehicle& vehicle);

/// Fixed wings: the bank is flown at the altitude that was commanded last, or that it
/// has; pitch, yaw, rates and thrust are left out.
void handle(const mavlink::SetAttitudeTarget& setpoint, ServedVehicle& vehicle);

/// A mission item that is none: go there (current 2), or change the altitude (3).
/// @returns  none for an item that is one.
std::optional<mavlink::MissionResult> guided_item(const mavlink::MissionItemInt& item,
                                                  ServedVehicle& vehicle);

/// Goes on keeping a heading.
void step_guided(ServedVehicle& vehicle);

}  // namespace skein::vehicle_services
