// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <variant>

#include "skein/data/airspace/zone_change.h"
#include "skein/data/event/plugin_record.h"
#include "skein/data/perimeter/fire.h"
#include "skein/data/perimeter/object.h"
#include "skein/data/team/mission.h"
#include "skein/data/team/mission_progress.h"
#include "skein/data/team/separation_message.h"
#include "skein/data/team/task_reason.h"
#include "skein/data/team/team_message.h"
#include "skein/data/team/team_task_report.h"
#include "skein/data/traffic/alert.h"
#include "skein/data/traffic/traffic.h"
#include "skein/data/vehicle/planner_change.h"

namespace skein {

/// What an agent may want to have recorded besides events: what it has measured or found,
/// zones that it has put into force or taken back, what it believes about a boundary or
/// an object now, what it forecasts, what its planners do, how its missions go, how
/// far it is with a stored mission, a conflict that is over, what it believes of other
/// traffic, who leads its team, what becomes of allocations and tasks, alerts and what
/// its pilot is shown, why it has given a task, a plugin's own. The simulation adds when,
/// who, and what was true.
using AgentRecord =
    std::variant<FireReading, Crossing, ZoneChange, PerimeterBelief, PluginRecord,
                 PlannerChange, ObjectBelief, MissionChange, PerimeterForecast,
                 ArrivalForecast, MissionProgress, ConflictReport, TrafficBelief,
                 TeamLead, TrafficAlert, FlightBands, Recommendation,
                 TeamAllocationReport, TaskReason, TeamTaskReport>;

}  // namespace skein
