// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

#include "skein/base/math.h"
#include "skein/geo/vec.h"

namespace skein {

/// A rotation as a unit quaternion; `q_NB` takes components in B to components in N.
using Quat = Eigen::Quaterniond;
using Mat3 = Eigen::Matrix3d;

namespace geo {

/// Attitude of a body B (forward, right, down) as angles: yaw about down, then pitch
/// about right, then roll about forward [rad].
struct Euler {
  double roll = 0;   ///< right wing down positive, in (-pi, pi]
  double pitch = 0;  ///< nose up positive, in [-pi/2, pi/2]
  double yaw = 0;    ///< clockwise from north, in (-pi, pi]
};

/// q_NB of these angles.
inline Quat from_euler(const Euler& e) {
  const double cr = math::cos(e.roll / 2), sr = math::sin(e.roll / 2);
  const double cp = math::cos(e.pitch / 2), sp = math::sin(e.pitch / 2);
  const double cy = math::cos(e.yaw / 2), sy = math::sin(e.yaw / 2);
  return {cr * cp * cy + sr * sp * sy, sr * cp * cy - cr * sp * sy,
          cr * sp * cy + sr * cp * sy, cr * cp * sy - sr * sp * cy};
}

/// Heading of the forward axis [rad], clockwise from north.
inline double yaw(const Quat& q_NB) {
  const double w = q_NB.w(), x = q_NB.x(), y = q_NB.y(), z = q_NB.z();
  return math::atan2(2 * (x * y + w * z), w * w + x * x - y * y - z * z);
}

/// Angles of q_NB. At pitch +-pi/2 roll and yaw are not distinguished: only their
/// difference (sum) is right.
inline Euler to_euler(const Quat& q_NB) {
  const double w = q_NB.w(), x = q_NB.x(), y = q_NB.y(), z = q_NB.z();
  const double sin_pitch = std::clamp(2 * (w * y - x * z), -1.0, 1.0);
  return {math::atan2(2 * (y * z + w * x), w * w - x * x - y * y + z * z),
          math::asin(sin_pitch), yaw(q_NB)};
}

/// The rotation by |v| [rad] about v.
inline Quat exp_so3(const Vec3& v) {
  const double angle2 = v.squaredNorm();
  double c = 1 - angle2 / 8, s = 0.5 - angle2 / 48;  // the next terms are below 1e-18
  if (angle2 > 1e-6) {
    const double angle = std::sqrt(angle2);
    c = math::cos(angle / 2);
    s = math::sin(angle / 2) / angle;
  }
  Quat q(c, s * v.x(), s * v.y(), s * v.z());
  q.normalize();
  return q;
}

/// The rotation vector of `q`, at most half a turn long: inverse of exp_so3.
inline Vec3 log_so3(const Quat& q) {
  const double sign = q.w() < 0 ? -1 : 1;
  const double s = q.vec().norm();
  // 2 atan(s/w)/s; the series where the quotient would be 0/0.
  const double scale =
      s < 1e-7 ? 2 / std::abs(q.w()) : 2 * math::atan2(s, sign * q.w()) / s;
  return sign * scale * q.vec();
}

/// `[v]x`: skew(v) u = v x u.
inline Mat3 skew(const Vec3& v) {
  Mat3 m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

/// Unit vector down, in components of B: the third row of R_NB.
inline Vec3 down_in_body(const Quat& q_NB) {
  const double w = q_NB.w(), x = q_NB.x(), y = q_NB.y(), z = q_NB.z();
  return {2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z};
}

}  // namespace geo
}  // namespace skein
