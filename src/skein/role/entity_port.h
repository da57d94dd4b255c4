// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "skein/base/time.h"
#include "skein/data/vehicle/entity_input.h"
#include "skein/data/vehicle/vehicle_report.h"

namespace skein {

/// The near end of a link to an entity whose vehicle and agent are in another program.
///
/// Threads: called by one at a time; what is behind it has a thread of its own. No call
/// waits.
class EntityPort {
 public:
  virtual ~EntityPort() = default;

  /// Appends what has come since the last call, in order: EntityReports and LinkChanges.
  /// Times are of the run's clock, those of states not after `now`.
  virtual void receive(Time now, std::vector<VehicleReport>& out) = 0;

  /// Hands something to the entity; nothing while the link is down.
  virtual void send(Time now, EntityInput input) = 0;
};

}  // namespace skein
