#include "skein/layer/asset/body/rigid_body.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include "skein/base/check.h"

namespace skein::asset {

Mat3 Inertia::tensor() const {
  Mat3 J;
  J << xx, -xy, -xz, -xy, yy, -yz, -xz, -yz, zz;
  return J;
}

bool Inertia::possible() const {
  if (!tensor().allFinite()) return false;
  Eigen::SelfAdjointEigenSolver<Mat3> solver;
  const Vec3 principal =
      solver.computeDirect(tensor(), Eigen::EigenvaluesOnly).eigenvalues();
  // In rising order. A flat plate has equality, which rounding may miss.
  return principal[0] > 0 && principal[2] <= (principal[0] + principal[1]) * (1 + 1e-9);
}

RigidBody::RigidBody(double mass, const Inertia& inertia)
    : mass_(mass),
      inverse_mass_(1 / mass),
      J_(inertia.tensor()),
      J_inverse_(J_.inverse()) {
  SKEIN_CHECK(mass > 0 && inertia.possible(), mass, inertia.xx, inertia.yy, inertia.zz);
}

}  // namespace skein::asset
