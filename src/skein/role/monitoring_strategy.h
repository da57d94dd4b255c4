// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "skein/data/perimeter/monitoring.h"

namespace skein {

/// Decides where the aircraft of a perimeter mission fly.
class MonitoringStrategy {
 public:
  virtual ~MonitoringStrategy() = default;

  /// New orders, at most one per aircraft, in the order of `situation.aircraft`; no two
  /// aircraft get the same place. Called about once a second; an order stays in force
  /// until a new one.
  virtual std::vector<Assignment> assign(const MonitoringSituation& situation) = 0;
};

}  // namespace skein
