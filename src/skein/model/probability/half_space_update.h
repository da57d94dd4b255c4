// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include <cmath>

#include "skein/geo/vec.h"
#include "skein/model/probability/truncated_normal.h"

namespace skein::model {

/// Gaussian belief about one control point of a boundary: position and velocity
/// [north, east, north rate, east rate] [m, m/s].
struct ControlPoint {
  Eigen::Vector4d mean = Eigen::Vector4d::Zero();
  Eigen::Matrix4d covariance = Eigen::Matrix4d::Zero();

  Vec2 position() const { return mean.head<2>(); }
  Vec2 velocity() const { return mean.tail<2>(); }
};

/// The motion p' = v over `dt` [s] with white acceleration noise.
/// @param noise  spectral density of the acceleration per axis [m^2/s^3].
/// Reference: [Rabinovich18] Eq. (2.12), (2.13), corrected.
void predict_point(ControlPoint& point, double dt, double noise);

/// A control point as an aircraft sees it: the range along the line of sight is
/// z = H x + noise with H = [a', 0, 0].
struct LineOfSight {
  Vec2 direction;         ///< a, unit vector from the aircraft to the point
  double range = 0;       ///< predicted z [m]
  double variance = 0;    ///< S = H P H' + R [m^2]
  Eigen::Vector4d cross;  ///< P H'
};

/// @param aircraft  [m], not at the point itself (then the range is 0 and no direction
///                  exists: the result has variance 0 and must not be used).
/// @param noise     R, variance of the range's noise [m^2].
LineOfSight look_at(const ControlPoint& point, const Vec2& aircraft, double noise);

/// Gives the range its new moments and carries them to the whole state.
///
///   x+ = x + K (m - z),   P+ = P - K (S - C) K',   K = P H'/S
///
/// The same as rotating into the frame of the line of sight and back (algorithm 1),
/// without the rotations.
/// @param corrected  m and C: mean and variance of the range after the reading.
/// Reference: [Rabinovich18] Eq. (2.22)-(2.24).
void correct_point(ControlPoint& point, const LineOfSight& seen,
                   const Moments& corrected);

/// The half-line that a reading leaves for the range, by the thesis's rule: if it is as
/// the predicted periphery says, the point stays where it is seen, else it is on the
/// other side of the aircraft.
inline Side side_of(bool observed_inside, bool expected_inside) {
  return observed_inside == expected_inside ? Side::kAbove : Side::kBelow;
}

/// One whole QKF update of one control point by one reading: exact first and second
/// moments for a Gaussian prior.
///
/// @returns   the moments of the range after the reading.
/// Cost:      about 40 ns, no allocation (bench_pointwise).
/// Reference: [Rabinovich18] algorithm 1, corrected.
Moments half_space_update(ControlPoint& point, const Vec2& aircraft, double noise,
                          Side side);

/// The usual Kalman update by a measured position.
/// @param where  [m].   @param sd  of the measurement, per axis [m], positive.
void locate_point(ControlPoint& point, const Vec2& where, double sd);

inline LineOfSight look_at(const ControlPoint& point, const Vec2& aircraft,
                           double noise) {
  LineOfSight seen;
  const Vec2 d = point.mean.head<2>() - aircraft;
  seen.range = d.norm();
  if (!(seen.range > 0)) return {Vec2::Zero(), 0, 0, Eigen::Vector4d::Zero()};
  seen.direction = d / seen.range;
  seen.cross = point.covariance.leftCols<2>() * seen.direction;
  seen.variance = seen.direction.dot(seen.cross.head<2>()) + noise;
  return seen;
}

inline void correct_point(ControlPoint& point, const LineOfSight& seen,
                          const Moments& corrected) {
  const double inverse = 1 / seen.variance;
  point.mean += seen.cross * ((corrected.mean - seen.range) * inverse);
  const double less = (seen.variance - corrected.variance) * inverse * inverse;
  const Eigen::Vector4d scaled = less * seen.cross;
  point.covariance.noalias() -= scaled * seen.cross.transpose();
}

}  // namespace skein::model
