// SPDX-License-Identifier: Apache-2.0
#include "skein/geo/local_frame.h"

#include <GeographicLib/LocalCartesian.hpp>
#include <cmath>

namespace skein::geo {

struct LocalFrame::Projection {
  GeographicLib::LocalCartesian cartesian;
};

LocalFrame::LocalFrame(const Geodetic& origin,
                       std::shared_ptr<const Projection> projection)
    : origin_(origin), projection_(std::move(projection)) {}

Result<LocalFrame> LocalFrame::at(const Geodetic& origin) {
  if (!std::isfinite(origin.latitude_deg) || std::abs(origin.latitude_deg) > 90)
    return Error{
        ErrorCode::kBadInput, "origin",
        fmt::format("latitude {} is outside -90 to 90 degrees.", origin.latitude_deg),
        ""};
  if (!std::isfinite(origin.longitude_deg) || !std::isfinite(origin.height_m))
    return Error{ErrorCode::kBadInput, "origin", "longitude and height must be finite.",
                 ""};
  return LocalFrame(
      origin, std::make_shared<const Projection>(Projection{GeographicLib::LocalCartesian(
                  origin.latitude_deg, origin.longitude_deg, origin.height_m)}));
}

Vec3 LocalFrame::to_local(const Geodetic& position) const {
  double east = 0, north = 0, up = 0;
  projection_->cartesian.Forward(position.latitude_deg, position.longitude_deg,
                                 position.height_m, east, north, up);
  return {north, east, -up};
}

Geodetic LocalFrame::to_geodetic(const Vec3& p_N) const {
  Geodetic position;
  projection_->cartesian.Reverse(p_N.y(), p_N.x(), -p_N.z(), position.latitude_deg,
                                 position.longitude_deg, position.height_m);
  return position;
}

Vec2 LocalFrame::to_plane(double latitude_deg, double longitude_deg) const {
  return to_local({latitude_deg, longitude_deg, origin_.height_m}).head<2>();
}

Geodetic LocalFrame::from_plane(const Vec2& p) const {
  // The point of the plane lies above the curved ground; drop it by the sagitta so that
  // to_plane(from_plane(p)) is p.
  double down = 0;
  Geodetic position;
  for (int i = 0; i < 3; ++i) {
    position = to_geodetic({p.x(), p.y(), down});
    down += position.height_m - origin_.height_m;
  }
  position.height_m = origin_.height_m;
  return position;
}

}  // namespace skein::geo
