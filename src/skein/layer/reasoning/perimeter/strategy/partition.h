// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/layer/reasoning/perimeter/strategy/boundary_line.h"
#include "skein/layer/reasoning/perimeter/strategy/gus.h"
#include "skein/layer/reasoning/perimeter/strategy/orders.h"
#include "skein/role/monitoring_strategy.h"

namespace skein::perimeter {

/// Each aircraft watches its own arc of the boundary, all arcs equally long, and flies
/// inside it where a crossing removes most uncertainty per second (as gus-rate does).
class PartitionStrategy : public MonitoringStrategy {
 public:
  explicit PartitionStrategy(const GusOptions& options);

  std::vector<Assignment> assign(const MonitoringSituation& situation) override;

 private:
  GusOptions options_;
  Orders orders_;
};

}  // namespace skein::perimeter
