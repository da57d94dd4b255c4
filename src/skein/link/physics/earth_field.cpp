// SPDX-License-Identifier: Apache-2.0
#include "skein/link/physics/earth_field.h"

#include "skein/base/math.h"
#include "skein/geo/rotation.h"

namespace skein::physics {
namespace {

// g10, g11, h11 [gauss].
constexpr double kAxial = -0.293500, kGreenwich = -0.014103, kEast = 0.045455;

}  // namespace

Vec3 earth_field(double latitude_deg, double longitude_deg,
                 std::optional<double> declination) {
  const double lat = geo::radians(latitude_deg), lon = geo::radians(longitude_deg);
  const double s = math::sin(lat), c = math::cos(lat);
  const double across = kGreenwich * math::cos(lon) + kEast * math::sin(lon);
  const double along = -kGreenwich * math::sin(lon) + kEast * math::cos(lon);
  // Minus the gradient of the potential of the first degree, at the surface.
  Vec3 field_N(across * s - kAxial * c, -along, -2 * (kAxial * s + across * c));
  if (declination) {
    const double horizontal = geo::horizontal(field_N).norm();
    field_N.x() = horizontal * math::cos(*declination);
    field_N.y() = horizontal * math::sin(*declination);
  }
  return field_N;
}

}  // namespace skein::physics
