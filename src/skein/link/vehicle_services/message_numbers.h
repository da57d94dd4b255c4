// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "skein/base/time.h"

// Numbers as messages carry them.

namespace skein::vehicle_services {

/// The nearest integer that fits; 0 for what is no number.
template <class Integer>
Integer rounded(double value) {
  using Limits = std::numeric_limits<Integer>;
  if (std::isnan(value)) return 0;
  return static_cast<Integer>(std::clamp(std::round(value),
                                         static_cast<double>(Limits::min()),
                                         static_cast<double>(Limits::max())));
}

/// The same where the largest number says that it is not known.
template <class Integer>
Integer rounded_below_max(double value) {
  return std::min(rounded<Integer>(value),
                  static_cast<Integer>(std::numeric_limits<Integer>::max() - 1));
}

inline float as_float(double value) {
  return static_cast<float>(value);
}

/// Milliseconds since the run's begin: what autopilots count since they were switched on.
inline std::uint32_t boot_ms(Time simulated) {
  return static_cast<std::uint32_t>(simulated.ns() / 1'000'000);
}
inline std::uint64_t boot_us(Time simulated) {
  return static_cast<std::uint64_t>(std::max<std::int64_t>(simulated.ns(), 0) / 1000);
}

}  // namespace skein::vehicle_services
