// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "skein/base/time.h"
#include "skein/geo/local_frame.h"
#include "skein/link/mavlink/messages.h"

namespace skein::vehicle_links {

/// Who an aircraft is for others.
struct TrafficIdentity {
  std::uint32_t icao_address = 0;
  std::string callsign;
  bool is_simulated = false;
};

/// Where an aircraft is, as it says itself.
struct TrafficState {
  Time time;                ///< when it was so, of the links' clock
  Vec3 p_N = Vec3::Zero();  ///< [m]
  Vec3 v_N = Vec3::Zero();  ///< over ground [m/s]
  /// The connection by which it is heard; none for what is simulated here.
  std::optional<std::uint32_t> line = std::nullopt;
};

/// An ICAO address that follows from the name alone. It is one of 0xF80000 to 0xFFFFFE,
/// which no state gives to its aircraft; two names may have the same one.
std::uint32_t icao_address(std::string_view name);

/// What fits into eight capital letters and digits of a name: "observer-12" is OBSERV12.
std::string callsign(std::string_view name);

/// ADSB_VEHICLE about an aircraft. The altitude is above mean sea level; below 0.5 m/s
/// over ground there is no valid heading.
/// @param now  what passed since state.time is in tslc [s].
mavlink::AdsbVehicle coded(const TrafficIdentity& who, const TrafficState& state,
                           Time now, const geo::LocalFrame& frame);

}  // namespace skein::vehicle_links
