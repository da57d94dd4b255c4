// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/communication/propagation/knife_edge.h"

#include <cmath>

#include "skein/base/math.h"

namespace skein::communication {

double knife_edge_loss_db(double v) {
  if (v <= -0.78) return 0;
  const double x = v - 0.1;
  return 6.9 + 20 * math::log10(std::sqrt(x * x + 1) + x);
}

double fresnel_parameter(double height, double d1, double d2, double wavelength) {
  return height * std::sqrt(2 / wavelength * (1 / d1 + 1 / d2));
}

}  // namespace skein::communication
