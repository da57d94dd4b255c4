#pragma once

#include <variant>

#include "skein/data/alert.h"
#include "skein/data/fire.h"
#include "skein/data/mission.h"
#include "skein/data/mission_progress.h"
#include "skein/data/object.h"
#include "skein/data/planner_change.h"
#include "skein/data/plugin_record.h"
#include "skein/data/separation_message.h"
#include "skein/data/task_reason.h"
#include "skein/data/team_message.h"
#include "skein/data/team_task_report.h"
#include "skein/data/traffic.h"
#include "skein/data/zone_change.h"

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
