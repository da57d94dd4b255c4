// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

namespace skein::asset {

/// `value` within [low, high]; `otherwise` when it is not a number. For commands, which
/// may be anything.
inline double bounded_or(double otherwise, double value, double low, double high) {
  return std::isnan(value) ? otherwise : std::clamp(value, low, high);
}

}  // namespace skein::asset
