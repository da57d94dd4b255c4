// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <array>

#include "skein/data/describe/strict_json.h"
#include "skein/exchange/team/case_lists.h"
#include "skein/exchange/team/team_cases.h"
#include "skein/solve/allocation/task_satisfaction.h"

namespace skein::exchange {
namespace {

using namespace solve;  // NOLINT: what is read is all of there
using strict_json::Fields;
using strict_json::Value;

constexpr double kMaxSpeed = 1000;     // [m/s]
constexpr double kMaxDuration = 1e7;   // [s]
constexpr double kMaxLength = 1e8;     // [m]
constexpr double kMinPositive = 1e-9;  // of what must be above 0

TeamAircraft read_aircraft(Fields& fields) {
  TeamAircraft aircraft;
  aircraft.place = read_point(fields, "");
  (void)fields.text("type", "");
  aircraft.v_min = fields.number("v_min_mps", 0, kMaxSpeed);
  aircraft.v_max = fields.number("v_max_mps", aircraft.v_min, kMaxSpeed);
  aircraft.cruise = fields.number("cruise_mps", 0, kMaxSpeed);
  aircraft.turn_radius = fields.number("turn_radius_m", 0, kMaxLength);
  aircraft.endurance = fields.number("endurance_s", 0, kMaxDuration);
  aircraft.relay_quality = fields.number("relay_quality", 0, 1, 0);
  for (const auto& [kind, value] : fields.members("sensors", kMaxListed)) {
    Fields sensor(value);
    aircraft.sensors[kind] = {sensor.number("swath_m", 0, kMaxLength),
                              sensor.number("quality", 0, 1)};
  }
  return aircraft;
}

ShareTask read_shares(Fields& fields, std::size_t aircraft) {
  ShareTask task;
  for (const Value& share : fields.items("shares", kMaxListed))
    task.shares.push_back(share.number(0, 1));
  if (task.shares.size() != aircraft)
    fields.problem("shares", "must have a number for each aircraft.");
  task.shares.resize(aircraft, 0);
  return task;
}

solve::TeamTask read_task(Fields& fields, std::size_t aircraft) {
  static const std::vector<std::string> kKinds = {
      "surveillance", "tracking", "patrol-line",   "perimeter-watch",
      "waypoints",    "route",    "protect",       "cordon",
      "escort",       "relay",    "measure-field", "fire-perimeter"};
  enum Kind {
    kSurvey,
    kTrack,
    kPatrol,
    kWatch,
    kWaypoints,
    kRoute,
    kProtect,
    kCordon,
    kEscort,
    kRelay,
    kField,
    kFire
  };
  solve::TeamTask task;
  task.place = read_point(fields, "");
  switch (static_cast<Kind>(fields.word("kind", kKinds))) {
    case kSurvey:
      task.what = SurveillanceTask{fields.text("sensor"),
                                   fields.number("area_m2", kMinPositive, 1e14)};
      break;
    case kTrack:
      task.what = TrackingTask{fields.text("sensor"),
                               fields.number("target_speed_mps", 0, kMaxSpeed)};
      break;
    case kPatrol:
      task.what = PatrolTask{fields.number("length_m", kMinPositive, kMaxLength),
                             fields.number("revisit_s", kMinPositive, kMaxDuration),
                             fields.flag("round", false)};
      break;
    case kWatch:
      task.what = PatrolTask{fields.number("length_m", kMinPositive, kMaxLength),
                             fields.number("revisit_s", kMinPositive, kMaxDuration),
                             fields.flag("round", true)};
      break;
    case kWaypoints:
    case kRoute:
      task.what = RouteTask{fields.number("length_m", 0, kMaxLength)};
      break;
    case kProtect:
    case kCordon:
    case kEscort:
      task.what =
          GuardTask{fields.text("sensor", ""), fields.number("aircraft_wanted", 1, 1e6)};
      break;
    case kRelay:
      task.what = RelayTask{read_point(fields, "from_"), read_point(fields, "to_"),
                            fields.number("range_m", kMinPositive, kMaxLength)};
      break;
    case kField:
    case kFire:
      task.what = read_shares(fields, aircraft);
      break;
  }
  return task;
}

CoalitionCase read_case(const Value& object, bool idle_allowed) {
  Fields fields(object);
  CoalitionCase found;
  found.id = fields.text("id");
  std::vector<TeamAircraft> aircraft;
  std::vector<std::int64_t> ids;
  read_list(fields, "aircraft", ids,
            [&](Fields& inner) { aircraft.push_back(read_aircraft(inner)); });
  std::vector<solve::TeamTask> tasks;
  read_list(fields, "tasks", found.tasks,
            [&](Fields& inner) { tasks.push_back(read_task(inner, aircraft.size())); });
  const double delta = fields.number("delta_d_per_m", 0, 1, 0);
  if (!idle_allowed && tasks.empty() && !aircraft.empty())
    fields.problem("tasks", "must not be empty when no aircraft may stay idle.");
  found.problem = coalition_problem(aircraft, tasks, delta, idle_allowed);
  return found;
}

}  // namespace

Result<std::vector<CoalitionCase>> read_coalition_cases(std::string_view text,
                                                        const std::string& place,
                                                        bool idle_allowed) {
  return read_cases<CoalitionCase>(
      text, place, [&](const Value& object) { return read_case(object, idle_allowed); });
}

}  // namespace skein::exchange
