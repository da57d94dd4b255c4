// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "skein/geo/vec.h"

namespace skein::physics {

/// The Earth's magnetic field as that of a dipole at its centre, as it is in 2025.
///
///   B = -grad V,  V = a (a / r)^2 (g sin(lat) + (g' cos(lon) + h' sin(lon)) cos(lat))
///
/// @param declination  in place of the dipole's [rad], east positive: the dipole's own is
///                     wrong by ten degrees and more in places.
/// @returns  [gauss], in N.
/// Reference: first-degree coefficients of IGRF-14.
Vec3 earth_field(double latitude_deg, double longitude_deg,
                 std::optional<double> declination = std::nullopt);

}  // namespace skein::physics
