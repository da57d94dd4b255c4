// SPDX-License-Identifier: Apache-2.0
#include "skein/link/vehicle_services/places.h"

#include <algorithm>
#include <cmath>

namespace skein::vehicle_services {
namespace {

using mavlink::CoordinateFrame;

constexpr double kMaxDistance = 500e3;  // from the run's origin [m]

// Units of an integer coordinate in a degree, a metre, or whatever it is.
double units_in(std::uint8_t frame) {
  switch (static_cast<CoordinateFrame>(frame)) {
    case CoordinateFrame::kMission:
      return 1;
    case CoordinateFrame::kLocalNed:
    case CoordinateFrame::kLocalOffsetNed:
    case CoordinateFrame::kBodyNed:
    case CoordinateFrame::kBodyOffsetNed:
    case CoordinateFrame::kBodyFrd:
      return 1e4;
    default:
      return 1e7;
  }
}

}  // namespace

double coordinate(std::uint8_t frame, std::int32_t value) {
  if (value == kNoCoordinate) return std::nan("");
  return value / units_in(frame);
}

std::int32_t integer_coordinate(std::uint8_t frame, double value) {
  if (!std::isfinite(value)) return kNoCoordinate;
  const double limit = kNoCoordinate - 1;
  return static_cast<std::int32_t>(
      std::clamp(std::round(value * units_in(frame)), -limit, limit));
}

std::int32_t degrees_e7(double degrees) {
  return integer_coordinate(static_cast<std::uint8_t>(CoordinateFrame::kGlobal), degrees);
}

std::optional<double> altitude_msl(std::uint8_t frame, double z, double home_msl) {
  switch (static_cast<CoordinateFrame>(frame)) {
    case CoordinateFrame::kGlobal:
    case CoordinateFrame::kGlobalInt:
      return z;
    case CoordinateFrame::kGlobalRelative:
    case CoordinateFrame::kGlobalRelativeInt:
      return home_msl + z;
    default:
      return std::nullopt;
  }
}

bool is_altitude(double altitude_msl) {
  return std::abs(altitude_msl) <= 50e3;
}

std::optional<Vec2> map_point(const geo::LocalFrame& frame, double latitude_deg,
                              double longitude_deg) {
  if (!(std::abs(latitude_deg) <= 90 && std::abs(longitude_deg) <= 180))
    return std::nullopt;
  const Vec3 point =
      frame.to_local({latitude_deg, longitude_deg, frame.origin().height_m});
  if (!(point.norm() <= kMaxDistance)) return std::nullopt;
  return geo::horizontal(point);
}

}  // namespace skein::vehicle_services
