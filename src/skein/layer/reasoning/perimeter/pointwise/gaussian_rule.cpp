// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/perimeter/pointwise/gaussian_rule.h"

#include <algorithm>

namespace skein::perimeter {

void ResetRule::crossing(std::size_t, model::ControlPoint& point, const Vec2& where,
                         double sd) {
  const double kept = std::max(sd, min_sd_);
  point.mean.head<2>() = where;
  point.covariance.topLeftCorner<2, 2>() = kept * kept * Eigen::Matrix2d::Identity();
  // What is left of the error has nothing to do with the rate any more.
  point.covariance.topRightCorner<2, 2>().setZero();
  point.covariance.bottomLeftCorner<2, 2>().setZero();
}

}  // namespace skein::perimeter
