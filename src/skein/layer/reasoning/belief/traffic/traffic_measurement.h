// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "skein/base/time.h"
#include "skein/data/traffic/traffic.h"
#include "skein/geo/rotation.h"

namespace skein::reasoning {

using skein::kTrafficSources;
using skein::TrafficSource;

/// Where another aircraft is, by one look of one source.
struct TrafficMeasurement {
  Time time;
  TrafficSource source = TrafficSource::kBroadcast;
  std::optional<std::uint32_t> address = {};  ///< that it sends itself
  Vec3 p_N = Vec3::Zero();                    ///< [m]
  Mat3 p_covariance = Mat3::Identity();       ///< [m^2]
  std::optional<Vec3> v_N = {};               ///< [m/s]
  double v_sd = 0;                            ///< of each axis of it [m/s]
};

/// What a radar or a passive detector measures from where it is.
struct PolarMeasurement {
  double range = 0, range_sd = 0;          ///< [m]
  double bearing = 0, bearing_sd = 0;      ///< from north, clockwise [rad]
  double elevation = 0, elevation_sd = 0;  ///< above the horizon [rad]
};

/// The place that a polar measurement means, with its covariance to first order in the
/// errors; in range at least what the errors of the angles make it longer on average.
TrafficMeasurement from_polar(Time time, TrafficSource source, const Vec3& own_p_N,
                              const PolarMeasurement& polar);

/// The same of a detector that measures the other's height over the own one, or nothing
/// of it.
/// @param height, height_sd  over the own one [m]; without: as high, off by 300 m.
TrafficMeasurement from_coarse(Time time, const Vec3& own_p_N, double range,
                               double range_sd, double bearing, double bearing_sd,
                               std::optional<double> height, double height_sd);

/// Whether all of it is finite and its covariance has positive variances.
bool is_sound(const TrafficMeasurement& measurement);

}  // namespace skein::reasoning
