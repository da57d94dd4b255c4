// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "skein/geo/local_frame.h"
#include "skein/geo/vec.h"
#include "skein/link/mavlink/constants.h"

// Places as messages give them.

namespace skein::vehicle_services {

/// Instead of a coordinate in an integer: none is given.
inline constexpr std::int32_t kNoCoordinate = 0x7fffffff;

/// A coordinate of a message's integer: degrees for global frames, metres for local ones,
/// the number itself where the frame says that there is no place. NaN for kNoCoordinate.
double coordinate(std::uint8_t frame, std::int32_t value);

/// The reverse; kNoCoordinate for what is no number. What does not fit is moved to the
/// nearest that does.
std::int32_t integer_coordinate(std::uint8_t frame, double value);

/// Degrees as messages carry them, in units of 1e-7.
std::int32_t degrees_e7(double degrees);

/// The altitude above mean sea level [m]; none for a frame without one, or that counts
/// from the ground at the place.
std::optional<double> altitude_msl(std::uint8_t frame, double z, double home_msl);

/// Whether an altitude above mean sea level can be one: within 50 km.
bool is_altitude(double altitude_msl);

/// Where a point is on the map; none for what is no point of the Earth, or further than
/// 500 km from the run's origin.
std::optional<Vec2> map_point(const geo::LocalFrame& frame, double latitude_deg,
                              double longitude_deg);

}  // namespace skein::vehicle_services
