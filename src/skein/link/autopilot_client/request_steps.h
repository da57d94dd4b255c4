// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "skein/data/vehicle/vehicle_request.h"
#include "skein/geo/local_frame.h"
#include "skein/link/autopilot_client/command_sender.h"
#include "skein/link/mavlink/flight_modes.h"

namespace skein::autopilot_client {

/// The commands that requests are made of.
enum : std::uint16_t {
  kNavWaypoint = 16,
  kNavLoiterUnlimited = 17,
  kNavLoiterTime = 19,
  kNavReturn = 20,
  kNavLand = 21,
  kNavTakeOff = 22,
  kDoSetMode = 176,
  kDoJump = 177,
  kDoChangeSpeed = 178,
  kDoLandStart = 189,
  kDoReposition = 192,
  kDoSetMissionCurrent = 224,
  kMissionStart = 300,
  kArmDisarm = 400,
  kSetMessageInterval = 511,
  kRequestMessage = 512,
};

/// What of a vehicle says how requests are put to it.
struct RequestTarget {
  mavlink::Make make = mavlink::Make::kOther;
  bool hovers = false;
  double home_msl = 0;  ///< altitudes of take-offs count from it [m]
};

/// How a request is put to a vehicle of that make: what is sent, one after the other.
///
/// Setpoints are none of these: they go out at once, unconfirmed. A fixed wing of
/// ArduPilot takes off in its mode TAKEOFF, and lands by a mission of an approach and a
/// landing, which replaces its stored one.
/// @returns  empty when it has no way to do it.
std::vector<RequestStep> steps_of(const VehicleRequest& request,
                                  const RequestTarget& target,
                                  const geo::LocalFrame& frame);

/// A command without a place.
mavlink::CommandLong command(std::uint16_t id, float param1 = 0, float param2 = 0,
                             float param3 = 0);

/// Longitude and latitude as messages have them [deg * 1e7].
struct ScaledPlace {
  std::int32_t latitude = 0, longitude = 0;
};
ScaledPlace scaled_place(const Vec2& p, const geo::LocalFrame& frame);

}  // namespace skein::autopilot_client
