// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/asset/body/rigid_body.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "skein/base/check.h"

namespace skein::asset {

Mat3 Inertia::tensor() const {
  Mat3 J;
  J << xx, -xy, -xz, -xy, yy, -yz, -xz, -yz, zz;
  return J;
}

bool Inertia::possible() const {
  // Moments along the principal axes are above 0, and none is larger than the other two
  // together, or half of the trace. A flat plate has equality, which rounding may miss.
  const Mat3 J = tensor();
  const double half = J.trace() * (1 + 1e-9) / (2 + 1e-9);
  const Mat3 room = half * Mat3::Identity() - J;
  const auto positive = [](const Mat3& m) { return m.llt().info() == Eigen::Success; };
  return J.allFinite() && positive(J) && positive(room);
}

RigidBody::RigidBody(double mass, const Inertia& inertia)
    : mass_(mass),
      inverse_mass_(1 / mass),
      J_(inertia.tensor()),
      J_inverse_(J_.inverse()) {
  SKEIN_CHECK(mass > 0 && inertia.possible(), mass, inertia.xx, inertia.yy, inertia.zz);
}

}  // namespace skein::asset
