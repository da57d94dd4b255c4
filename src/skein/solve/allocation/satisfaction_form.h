// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

#include "skein/solve/allocation/coalitions.h"

namespace skein::solve {

/// Sums that reach 1 up to rounding reach it: three thirds are a whole group.
inline constexpr double kWhole = 1 - 1e-12;

/// Satisfaction by what the members bring: their sum, for kBest the largest.
inline double satisfaction_of_sum(Satisfaction form, double brought) {
  switch (form) {
    case Satisfaction::kRoot:
      return brought >= kWhole ? std::sqrt(brought) : 0;
    case Satisfaction::kBest:
      return brought;
    case Satisfaction::kShare:
      return std::min(1.0, brought);
  }
  return 0;
}

}  // namespace skein::solve
