// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>

#include "skein/geo/vec.h"

namespace skein::communication {

/// Two places in an order that does not depend on which of them sends: what is computed
/// from them is the same to the last bit in both directions.
inline std::pair<Vec3, Vec3> ordered_ends(const Vec3& a, const Vec3& b) {
  for (int axis = 0; axis < 3; ++axis) {
    if (a[axis] < b[axis]) return {a, b};
    if (a[axis] > b[axis]) return {b, a};
  }
  return {a, b};
}

}  // namespace skein::communication
