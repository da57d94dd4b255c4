// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "skein/model/levelset/field.h"

namespace skein::model {

/// How fast a front moves along its outward normal n: max(0, local + drift . n).
struct FrontSpeed {
  std::span<const float> local;  ///< per node of the grid [m/s]
  Vec2 drift = Vec2::Zero();     ///< the same everywhere, as of a wind [m/s]
};

/// Moves the zero contour of `phi` (negative inside) outwards for `dt` [s]:
///
///   phi_t + R |grad phi| = 0,   R = max(0, local + drift . n),  n = grad phi / |grad
///   phi|
///
/// by second-order upwind differences (ENO) in Godunov's flux and Heun's steps, as many
/// as keep R dt below half a cell. Only nodes with |phi| < `band` [m] are moved, so phi
/// stops being a distance further out: see reinitialise().
///
/// Valid: the front stays three cells or more inside the grid; the outermost two rows and
///        columns are not moved.
/// Cost:  about 2 * 20 ns per node in the band and step, see bench/ensemble_bench.cpp.
/// Reference: [Osher88] (2.1); [Sethian99] (6.34) for the second-order differences.
void advance(Field& phi, const FrontSpeed& speed, double dt, double band);

}  // namespace skein::model
