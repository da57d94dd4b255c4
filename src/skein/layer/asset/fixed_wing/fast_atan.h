// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "skein/base/math.h"

namespace skein::asset {

/// math::atan2(y, x), several times as fast where |y| < 0.32 x.
///
/// There a polynomial of degree 9 in (y/x)^2, an economised series, has a relative error
/// of 8e-18 before rounding.
inline double fast_atan2(double y, double x) {
  if (!(std::abs(y) < 0.32 * x)) [[unlikely]]
    return math::atan2(y, x);
  const double t = y / x;
  const double s = t * t, s2 = s * s, s4 = s2 * s2;
  // In pairs, so that the processor can work on several at once (Estrin).
  const double p01 = -3.33333333333318992953e-01 + s * 1.99999999995370880690e-01;
  const double p23 = -1.42857142275920973029e-01 + s * 1.11111073955631176058e-01;
  const double p45 = -9.09077217528245634659e-02 + s * 7.68921934347561175649e-02;
  const double p67 = -6.62314487060259027285e-02 + s * 5.50479980565841409135e-02;
  const double low = p01 + s2 * p23;
  const double high = p45 + s2 * p67 - s4 * 3.36632037403960873712e-02;
  return t + t * s * (low + s4 * high);
}

}  // namespace skein::asset
