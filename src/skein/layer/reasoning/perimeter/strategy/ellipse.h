// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/layer/reasoning/perimeter/strategy/boundary_line.h"
#include "skein/layer/reasoning/perimeter/strategy/orders.h"
#include "skein/role/monitoring_strategy.h"

namespace skein::perimeter {

struct EllipseOptions {
  double separation = 150;  ///< between the targets of two aircraft, at least [m]
  double switch_ratio = 1;  ///< change when another axis is this many times longer
  double patience = 300;    ///< an order not done after this time is renewed [s]
};

/// Flies to the tip of the largest major axis of the position ellipses, and switches when
/// another axis grows longer.
/// Reference: [Rabinovich18] section 4.
class EllipseStrategy : public MonitoringStrategy {
 public:
  explicit EllipseStrategy(const EllipseOptions& options);

  std::vector<Assignment> assign(const MonitoringSituation& situation) override;

 private:
  EllipseOptions options_;
  Orders orders_;
};

}  // namespace skein::perimeter
