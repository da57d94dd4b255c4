// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "skein/base/id.h"
#include "skein/base/time.h"
#include "skein/data/event/event.h"
#include "skein/data/event/record.h"
#include "skein/data/perimeter/object.h"
#include "skein/data/vehicle/payload.h"
#include "skein/geo/vec.h"

namespace skein {

/// What the server of a run knows of the physical world, which it learns only from what
/// physical sensors say.
///
/// Threads: one; what remembered() returns may be read by many until the next call.
class WorldMemory {
 public:
  virtual ~WorldMemory() = default;

  /// A step begins: what is too old is forgotten.
  virtual void begin_step(Time now) = 0;

  /// Where an aircraft that takes part is at `now`, in N [m].
  virtual void take_position(Time now, EntityId aircraft, const Vec3& p_N) = 0;

  /// What one payload sensor of an aircraft has said since the last step, as recorded.
  virtual void take_payload(Time now, EntityId aircraft,
                            std::span<const Footprint> pictures,
                            std::span<const Detection> detections) = 0;

  /// Physical objects as they are remembered, in order of their ids: all that whoever is
  /// not there may see of them.
  virtual std::span<const VisibleObject> remembered() const = 0;

  /// Appends what has become of observations, and what is worth reporting, since the last
  /// call.
  virtual void take_news(std::vector<ObservationRecord>& observations,
                         std::vector<Event>& events) = 0;
};

}  // namespace skein
