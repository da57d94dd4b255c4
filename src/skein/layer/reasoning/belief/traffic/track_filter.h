// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/layer/reasoning/belief/traffic/traffic_measurement.h"

namespace skein::reasoning {

/// Where another aircraft is believed to be, how it moves, and how well that is known.
struct TrafficState {
  Vec3 p_N = Vec3::Zero();  ///< [m]
  Vec3 v_N = Vec3::Zero();  ///< [m/s]
  Mat3 pp = Mat3::Zero();   ///< covariance of the position [m^2],
  Mat3 pv = Mat3::Zero();   ///< of position and velocity [m^2/s],
  Mat3 vv = Mat3::Zero();   ///< of the velocity [m^2/s^2]

  /// Of the position, in the worst horizontal direction [m].
  double horizontal_sd() const;
  double vertical_sd() const;  ///< [m]
};

/// A Kalman filter of even motion whose velocity is changed by random accelerations:
///
///   p' = p + v t,  v' = v,  Q = q [t^3/3  t^2/2; t^2/2  t]
///
/// with spectral densities q of 1.5^2 m^2/s^3 sideways and 0.7^2 up and down. Position
/// and velocity are measured one after the other; the update is Joseph's.
/// Reference: [BarShalom01] section 6.2.
class TrackFilter {
 public:
  explicit TrackFilter(const TrafficMeasurement& first);

  /// The state at a time, not before the last measurement's: carried on.
  TrafficState at(Time time) const;

  /// How far a measurement is from where it was to be expected, squared, in standard
  /// deviations of both together: chi-square of three dimensions.
  double distance2(const TrafficMeasurement& measurement) const;

  /// Takes in a measurement; an older one than the last as if it had been carried on.
  void update(const TrafficMeasurement& measurement);

  Time time() const { return time_; }  ///< of the last measurement

 private:
  Time time_;
  TrafficState state_;
};

}  // namespace skein::reasoning
