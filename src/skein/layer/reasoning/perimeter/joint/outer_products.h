// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

namespace skein::perimeter {

/// A vector x and the factor of x x'.
struct OuterProduct {
  const Eigen::VectorXd& x;
  double gain = 0;
};

/// P += gain x x' in the part of P that a BoundaryFilter keeps: the lower triangle, and
/// of the columns from `full` on all rows from `full` on.
///
/// Each element is computed as by the plain loop, to the last bit, whatever the processor
/// has; where it has 256-bit registers they are used.
/// Cost: no allocation; size^2 / 2 and some more multiplications.
void add_outer_product(Eigen::MatrixXd& P, Eigen::Index full,
                       const OuterProduct& product);

/// Two of them, the first before the second in each element, in one pass over P.
void add_outer_products(Eigen::MatrixXd& P, Eigen::Index full, const OuterProduct& first,
                        const OuterProduct& second);

}  // namespace skein::perimeter
