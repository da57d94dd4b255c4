// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/belief/traffic/traffic_measurement.h"

#include <algorithm>
#include <cmath>

#include "skein/base/math.h"

namespace skein::reasoning {
namespace {

constexpr double kUnknownHeight = 300;  // standard deviation of a height not measured [m]

}  // namespace

TrafficMeasurement from_polar(Time time, TrafficSource source, const Vec3& own_p_N,
                              const PolarMeasurement& polar) {
  const double c = math::cos(polar.elevation), s = math::sin(polar.elevation);
  const Vec2 ahead = geo::unit(polar.bearing);
  const Vec3 along(c * ahead.x(), c * ahead.y(), -s);
  const Vec2 right = geo::turned_right(ahead);
  Mat3 axes;  // along, aside, up: what range, bearing and elevation change
  axes.col(0) = along;
  axes.col(1) = Vec3(right.x(), right.y(), 0);
  axes.col(2) = Vec3(-s * ahead.x(), -s * ahead.y(), -c);
  const double range = polar.range;
  // An arc's chord is shorter than the arc: errors of angles shorten what is along.
  const double shortened =
      range *
      (polar.bearing_sd * polar.bearing_sd + polar.elevation_sd * polar.elevation_sd) / 2;
  const Vec3 sd(std::max(polar.range_sd, shortened), range * c * polar.bearing_sd,
                range * polar.elevation_sd);
  TrafficMeasurement out;
  out.time = time;
  out.source = source;
  out.p_N = own_p_N + range * along;
  out.p_covariance = axes * sd.cwiseAbs2().asDiagonal() * axes.transpose();
  return out;
}

TrafficMeasurement from_coarse(Time time, const Vec3& own_p_N, double range,
                               double range_sd, double bearing, double bearing_sd,
                               std::optional<double> height, double height_sd) {
  TrafficMeasurement out = from_polar(time, TrafficSource::kPassive, own_p_N,
                                      {range, range_sd, bearing, bearing_sd, 0, 0});
  const double sd = height ? height_sd : kUnknownHeight;
  out.p_N.z() -= height.value_or(0);
  out.p_covariance(2, 2) = sd * sd;
  return out;
}

bool is_sound(const TrafficMeasurement& measurement) {
  return measurement.p_N.allFinite() && measurement.p_covariance.allFinite() &&
         measurement.p_covariance.diagonal().minCoeff() > 0 &&
         (!measurement.v_N || (measurement.v_N->allFinite() &&
                               std::isfinite(measurement.v_sd) && measurement.v_sd > 0));
}

}  // namespace skein::reasoning
