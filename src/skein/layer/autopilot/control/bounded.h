// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace skein::autopilot {

/// `x` within [low, high]; what is not a number becomes `low`, so that no integrator
/// keeps it.
inline double bounded(double x, double low, double high) {
  if (!(x > low)) return low;
  return x < high ? x : high;
}

/// `x` within [-most, most]; what is not a number becomes 0.
inline double bounded(double x, double max) {
  if (x != x) return 0;
  return bounded(x, -max, max);
}

}  // namespace skein::autopilot
