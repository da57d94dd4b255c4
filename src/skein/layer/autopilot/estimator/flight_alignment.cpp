// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/autopilot/estimator/flight_alignment.h"

#include "skein/data/vehicle/air.h"

namespace skein::autopilot {
namespace {

constexpr double kParallel = 0.1;  // sine of the angle between two vectors

// Orthonormal columns: along `a`, across `a` and `b`, and across these.
std::optional<Mat3> triad(const Vec3& a, const Vec3& b) {
  const Vec3 across = a.cross(b);
  if (!(across.norm() > kParallel * a.norm() * b.norm())) return std::nullopt;
  Mat3 m;
  m.col(0) = a.normalized();
  m.col(1) = across.normalized();
  m.col(2) = m.col(0).cross(m.col(1));
  return m;
}

}  // namespace

void FlightAlignment::add(const Vec3& w_B, const Vec3& f_B, double dt) {
  const Quat half = geo::exp_so3(0.5 * dt * w_B);
  gained_ += dt * (turned_ * (half * f_B));
  turned_ = (turned_ * half * half).normalized();
}

std::optional<Quat> FlightAlignment::attitude(Time now, const Vec3& v_N, const Vec3& u_B,
                                              const Vec3& u_N) const {
  const Vec3 seen = v_N - v_N_ - Vec3(0, 0, kGravity * (now - begin_).seconds());
  const auto of_body = triad(turned_.conjugate() * gained_, u_B);
  const auto of_map = triad(seen, u_N);
  if (!of_body || !of_map) return std::nullopt;
  return Quat(Mat3(*of_map * of_body->transpose())).normalized();
}

}  // namespace skein::autopilot
