// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <variant>

#include "skein/data/describe/describe.h"
#include "skein/data/event/event.h"
#include "skein/data/event/plugin_record.h"
#include "skein/data/perimeter/fire.h"
#include "skein/data/perimeter/object.h"
#include "skein/data/radio/message.h"
#include "skein/data/team/mission_progress.h"
#include "skein/data/traffic/alert.h"
#include "skein/data/traffic/traffic.h"
#include "skein/data/vehicle/autopilot.h"
#include "skein/data/vehicle/payload.h"
#include "skein/data/vehicle/planner_change.h"
#include "skein/data/vehicle/vehicle.h"

// What an entity says whose vehicle and agent are both in another program.

namespace skein {

/// How its vehicle is.
struct RemoteState {
  NavEstimate nav;
  AutopilotStatus status;
  std::string refused;                ///< AutopilotStatus::refused
  std::optional<VehicleState> truth;  ///< of a simulated one
  Time truth_time;                    ///< when that is true
  bool lost = false;                  ///< it takes no further part
};

constexpr auto describe(const RemoteState*) {
  using T = RemoteState;
  return described<T>({"state"}, "How a vehicle in another program is.",
                      field("nav", &T::nav, "what its autopilot believes"),
                      field("status", &T::status, "what its autopilot does"),
                      field("refused", &T::refused, "why the last refusal was"),
                      field("truth", &T::truth, "of a simulated one"),
                      field("truth_time", &T::truth_time, "when that is true"),
                      field("lost", &T::lost, "it takes no further part"));
}

/// New kinds go to the end: the place in this list is part of the wire form.
using EntitySaying =
    std::variant<RemoteState, Message, Event, FireReading, Crossing, PluginRecord,
                 PlannerChange, MissionProgress, ObjectBelief, RegionOfInterest,
                 ConflictReport, TrafficBelief, TeamLead, TrafficAlert, FlightBands,
                 Recommendation, TeamAllocationReport>;

/// One thing that such an entity says.
struct EntityReport {
  EntitySaying said;
};

constexpr auto describe(const EntityReport*) {
  using T = EntityReport;
  return described<T>({"entity"}, "What an entity in another program says.",
                      field("said", &T::said, Storage::kJson, "what"));
}

}  // namespace skein
