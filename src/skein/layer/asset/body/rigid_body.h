// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/data/vehicle/air.h"
#include "skein/data/vehicle/vehicle.h"
#include "skein/geo/rotation.h"
#include "skein/geo/vec.h"

namespace skein::asset {

/// Moments and products of inertia about the centre of gravity, axes of B [kg m^2].
///
///   J = [[xx, -xy, -xz], [-xy, yy, -yz], [-xz, -yz, zz]]
struct Inertia {
  double xx = 1, yy = 1, zz = 1;
  double xy = 0, xz = 0, yz = 0;  ///< products; xy = yz = 0 when left mirrors right

  Mat3 tensor() const;

  /// Whether some body has this inertia: J is positive definite, and no principal moment
  /// is more than the other two together.
  bool possible() const;
};

/// How a rigid body resists force and moment.
class RigidBody {
 public:
  /// `mass` [kg] above 0, `inertia` possible; else a Bug.
  RigidBody(double mass, const Inertia& inertia);

  double mass() const { return mass_; }
  double inverse_mass() const { return inverse_mass_; }
  const Mat3& inertia() const { return J_; }

  /// Rate of the rate of turn, Euler's equation: J w' = M - w x (J w) [rad/s^2].
  [[gnu::always_inline]] Vec3 angular_acceleration(const Vec3& w_NB_B,
                                                   const Vec3& moment_B) const {
    // In scalars, as Eigen's small products are slow here; both matrices are symmetric.
    const double p = w_NB_B.x(), q = w_NB_B.y(), r = w_NB_B.z();
    const double hx = J_(0, 0) * p + J_(1, 0) * q + J_(2, 0) * r;
    const double hy = J_(1, 0) * p + J_(1, 1) * q + J_(2, 1) * r;
    const double hz = J_(2, 0) * p + J_(2, 1) * q + J_(2, 2) * r;
    const double x = moment_B.x() - (q * hz - r * hy);
    const double y = moment_B.y() - (r * hx - p * hz);
    const double z = moment_B.z() - (p * hy - q * hx);
    return {J_inverse_(0, 0) * x + J_inverse_(1, 0) * y + J_inverse_(2, 0) * z,
            J_inverse_(1, 0) * x + J_inverse_(1, 1) * y + J_inverse_(2, 1) * z,
            J_inverse_(2, 0) * x + J_inverse_(2, 1) * y + J_inverse_(2, 2) * z};
  }

 private:
  double mass_, inverse_mass_;
  Mat3 J_, J_inverse_;
};

/// How a rigid body moves: what RK4 integrates.
struct Motion {
  Vec3 p_N = Vec3::Zero();       ///< [m]
  Vec3 v_N = Vec3::Zero();       ///< over ground [m/s]
  Quat q_NB = Quat::Identity();  ///< not quite of unit length within a step
  Vec3 w_NB_B = Vec3::Zero();    ///< [rad/s]
};

inline Motion motion_of(const VehicleState& s) {
  return {s.p_N, s.v_N, s.q_NB, s.w_NB_B};
}
inline void set_motion(VehicleState& s, const Motion& m) {
  s.p_N = m.p_N;
  s.v_N = m.v_N;
  s.q_NB = m.q_NB;
  s.w_NB_B = m.w_NB_B;
}

/// What acts on a body: everything but gravity as force and moment, gravity apart.
struct Loads {
  Vec3 force_B = Vec3::Zero();   ///< [N]
  Vec3 moment_B = Vec3::Zero();  ///< about the centre of gravity [N m]
  double gravity = kGravity;     ///< downwards [m/s^2]
};

/// One of the four evaluations of a step.
struct Stage {
  const Motion& motion;
  const Mat3& R_NB;  ///< of the attitude, a rotation to rounding
  int halves;        ///< half steps since the step's beginning: 0, 1, 1, 2
};

// What the stages of a step call is inlined by force: left to itself the compiler hands
// small structs over in memory, which makes a fixed wing's step a third slower.

/// Components in B of a vector in N.
[[gnu::always_inline]] inline Vec3 in_body(const Mat3& R_NB, const Vec3& v_N) {
  const double x = v_N.x(), y = v_N.y(), z = v_N.z();
  return {R_NB(0, 0) * x + R_NB(1, 0) * y + R_NB(2, 0) * z,
          R_NB(0, 1) * x + R_NB(1, 1) * y + R_NB(2, 1) * z,
          R_NB(0, 2) * x + R_NB(1, 2) * y + R_NB(2, 2) * z};
}

/// The rotation matrix of q / |q|.
[[gnu::always_inline]] inline Mat3 rotation(const Quat& q) {
  const double w = q.w(), x = q.x(), y = q.y(), z = q.z();
  const double s = 2 / (w * w + x * x + y * y + z * z);
  const double sx = s * x, sy = s * y, sz = s * z;
  const double xx = sx * x, yy = sy * y, zz = sz * z;
  const double xy = sx * y, xz = sx * z, yz = sy * z;
  const double wx = sx * w, wy = sy * w, wz = sz * w;
  Mat3 R;
  R << 1 - (yy + zz), xy - wz, xz + wy,  //
      xy + wz, 1 - (xx + zz), yz - wx,   //
      xz - wy, yz + wx, 1 - (xx + yy);
  return R;
}

namespace detail {

// Rates of a Motion.
struct MotionRate {
  Vec3 v_N, a_N;
  Eigen::Vector4d q;  // x, y, z, w as Eigen stores them
  Vec3 w_B;
};

[[gnu::always_inline]] inline Motion moved(const Motion& m, const MotionRate& k,
                                           double dt) {
  Motion next;
  next.p_N = m.p_N + dt * k.v_N;
  next.v_N = m.v_N + dt * k.a_N;
  next.q_NB.coeffs() = m.q_NB.coeffs() + dt * k.q;
  next.w_NB_B = m.w_NB_B + dt * k.w_B;
  return next;
}

template <class LoadsAt>
MotionRate motion_rate(const RigidBody& body, const Motion& m, int halves,
                       const LoadsAt& loads_at) {
  const Mat3 R_NB = rotation(m.q_NB);
  const Loads loads = loads_at(Stage{m, R_NB, halves});
  MotionRate k;
  k.v_N = m.v_N;
  const double im = body.inverse_mass();
  const double ax = im * loads.force_B.x(), ay = im * loads.force_B.y(),
               az = im * loads.force_B.z();
  k.a_N = {R_NB(0, 0) * ax + R_NB(0, 1) * ay + R_NB(0, 2) * az,
           R_NB(1, 0) * ax + R_NB(1, 1) * ay + R_NB(1, 2) * az,
           R_NB(2, 0) * ax + R_NB(2, 1) * ay + R_NB(2, 2) * az + loads.gravity};
  const double p = 0.5 * m.w_NB_B.x(), q = 0.5 * m.w_NB_B.y(), r = 0.5 * m.w_NB_B.z();
  const double w = m.q_NB.w(), x = m.q_NB.x(), y = m.q_NB.y(), z = m.q_NB.z();
  k.q << w * p + y * r - z * q, w * q + z * p - x * r, w * r + x * q - y * p,
      -(x * p + y * q + z * r);
  k.w_B = body.angular_acceleration(m.w_NB_B, loads.moment_B);
  return k;
}

}  // namespace detail

/// Moves a rigid body on by `dt` [s] by the classical Runge-Kutta method of order 4.
///
///   p' = v,  v' = R force/m + (0, 0, gravity),  q' = q (0, w)/2,  J w' = M - w x (J w)
///
/// The quaternion is normalised at the step's end; within it the attitude is q/|q|. The
/// velocity is kept in N, so free flight keeps its momentum exactly.
/// @param loads_at  callable (const Stage&) -> Loads; called four times, must be smooth
///                  within the step for the error to be of order dt^4.
template <class LoadsAt>
void rk4_step(const RigidBody& body, Motion& motion, double dt, const LoadsAt& loads_at) {
  using detail::moved;
  const Motion start = motion;
  const auto k1 = detail::motion_rate(body, start, 0, loads_at);
  const auto k2 = detail::motion_rate(body, moved(start, k1, dt / 2), 1, loads_at);
  const auto k3 = detail::motion_rate(body, moved(start, k2, dt / 2), 1, loads_at);
  const auto k4 = detail::motion_rate(body, moved(start, k3, dt), 2, loads_at);
  const double h = dt / 6;
  motion.p_N += h * (k1.v_N + 2 * (k2.v_N + k3.v_N) + k4.v_N);
  motion.v_N += h * (k1.a_N + 2 * (k2.a_N + k3.a_N) + k4.a_N);
  motion.q_NB.coeffs() += h * (k1.q + 2 * (k2.q + k3.q) + k4.q);
  motion.q_NB.coeffs() /= std::sqrt(motion.q_NB.squaredNorm());
  motion.w_NB_B += h * (k1.w_B + 2 * (k2.w_B + k3.w_B) + k4.w_B);
}

}  // namespace skein::asset
