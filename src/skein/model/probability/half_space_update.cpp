// SPDX-License-Identifier: Apache-2.0
#include "skein/model/probability/half_space_update.h"

namespace skein::model {

void predict_point(ControlPoint& point, double dt, double noise) {
  point.mean.head<2>() += dt * point.mean.tail<2>();
  // F P F' by blocks: F = [I, dt I; 0, I].
  Eigen::Matrix4d& P = point.covariance;
  P.topRows<2>() += dt * P.bottomRows<2>();
  P.leftCols<2>() += dt * P.rightCols<2>();
  const double rate = noise * dt, mixed = rate * dt / 2, position = rate * dt * dt / 3;
  for (int i : {0, 1}) {
    P(i, i) += position;
    P(i, i + 2) += mixed;
    P(i + 2, i) += mixed;
    P(i + 2, i + 2) += rate;
  }
  // Rounding is not symmetric; without this the difference would grow over a long run.
  P = (0.5 * (P + P.transpose())).eval();
}

Moments half_space_update(ControlPoint& point, const Vec2& aircraft, double noise,
                          Side side) {
  const LineOfSight seen = look_at(point, aircraft, noise);
  if (!(seen.variance > 0)) return {seen.range, 0};
  const Moments corrected =
      truncate_one_sided(seen.range, std::sqrt(seen.variance), 0, side);
  correct_point(point, seen, corrected);
  return corrected;
}

void locate_point(ControlPoint& point, const Vec2& where, double sd) {
  // The axes' errors are independent: one scalar update after the other.
  for (int axis : {0, 1}) {
    LineOfSight seen;
    seen.cross = point.covariance.col(axis);
    seen.variance = point.covariance(axis, axis) + sd * sd;
    seen.range = point.mean(axis);
    correct_point(point, seen, {.mean = where(axis), .variance = 0});
  }
}

}  // namespace skein::model
