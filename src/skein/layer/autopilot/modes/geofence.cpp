// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/autopilot/modes/geofence.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "skein/base/check.h"

namespace skein::autopilot {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();

double squared_distance_to_edge(const Vec2& a, const Vec2& b, const Vec2& p) {
  const Vec2 edge = b - a;
  const double square = edge.squaredNorm();
  const double along = square > 0 ? std::clamp(edge.dot(p - a) / square, 0.0, 1.0) : 0.0;
  return (a + along * edge - p).squaredNorm();
}

}  // namespace

std::optional<std::string> error_in(const GeofenceOptions& options) {
  for (const geo::Ring& ring : options.area)
    if (ring.size() < 3)
      return fmt::format("area: {} corners enclose nothing; at least 3", ring.size());
  if (!(options.ceiling_msl > options.floor_msl))
    return fmt::format("ceiling_msl: {} m must be above the floor, {} m",
                       options.ceiling_msl, options.floor_msl);
  const std::pair<const char*, double> lengths[] = {{"margin", options.margin},
                                                    {"hysteresis", options.hysteresis},
                                                    {"look_ahead", options.look_ahead}};
  for (const auto& [name, value] : lengths)
    if (!(value >= 0 && value <= 1e6))
      return fmt::format("{}: {} must be from 0 to 1e6", name, value);
  return std::nullopt;
}

Geofence::Geofence(GeofenceOptions options) : options_(std::move(options)) {
  const auto error = error_in(options_);
  SKEIN_CHECK(!error, *error);
}

double Geofence::horizontal_clearance(const Vec2& p) const {
  if (options_.area.empty()) return kFar;
  bool inside = false;
  double nearest = kFar;
  for (const geo::Ring& ring : options_.area) {
    Vec2 a = ring.back();
    for (const Vec2& b : ring) {
      if (geo::ray_crosses(a, b, p)) inside = !inside;
      nearest = std::min(nearest, squared_distance_to_edge(a, b, p));
      a = b;
    }
  }
  return inside ? std::sqrt(nearest) : -std::sqrt(nearest);
}

double Geofence::clearance(const Vec3& p_N, bool floor_counts) const {
  const double altitude = -p_N.z();
  double min = std::min(horizontal_clearance(geo::horizontal(p_N)),
                        options_.ceiling_msl - altitude);
  if (floor_counts) min = std::min(min, altitude - options_.floor_msl);
  return min - options_.margin;
}

bool FenceWatch::measure(const Vec3& p_N, const Vec3& v_N, bool floor_counts) {
  const GeofenceOptions& options = fence_->options();
  const double here = fence_->clearance(p_N, floor_counts);
  const double clearance =
      options.look_ahead > 0
          ? std::min(here,
                     fence_->clearance(p_N + options.look_ahead * v_N, floor_counts))
          : here;
  outside_ = clearance <= (outside_ ? options.hysteresis : 0);
  anchor_ = p_N;
  floor_counted_ = floor_counts;
  // Inside, all within `here` of the anchor is inside too. Outside, every step measures:
  // it is rare, and both points would have to be known to stay outside.
  calm_ = outside_ ? 0 : here * here;
  return outside_;
}

}  // namespace skein::autopilot
