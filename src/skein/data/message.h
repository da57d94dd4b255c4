#pragma once

#include <cstdint>
#include <variant>

#include "skein/base/id.h"
#include "skein/base/time.h"
#include "skein/data/fire.h"
#include "skein/data/task.h"
#include "skein/data/vehicle.h"
#include "skein/data/zone_change.h"

namespace skein {

/// What an aircraft tells the team about itself, once a second.
struct AircraftReport {
  NavEstimate nav;
  FlightLimits limits;
  std::uint32_t task_number = 0;  ///< the task it works on; 0 = none yet
  bool task_done = false;
  /// False while a pilot or a failsafe flies: then orders wait.
  bool obeys = true;
  /// It knows all changes of no-flight zones up to this number.
  std::uint32_t zone_changes = 0;
};

/// Where an aircraft of the team is, told on by the ground station or by itself.
struct TeamPosition {
  EntityId aircraft;
  NavEstimate nav;
};

/// The sender is there, nothing more.
struct SignOfLife {};

/// A message between agents. `number` counts the sender's messages.
struct Message {
  EntityId from;
  EntityId to;
  std::uint64_t number = 0;
  Time sent;
  int size_bytes = 0;  ///< as coded on the air
  std::variant<FireReading, AircraftReport, Task, SignOfLife, TeamPosition, ZoneChange>
      content;
};

}  // namespace skein
