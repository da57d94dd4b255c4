// SPDX-License-Identifier: Apache-2.0
#include "skein/assemble/kinds/mission_fields.h"

#include <fmt/format.h>

#include <algorithm>

namespace skein::assemble {

Result<MissionTeam> team_of(const MissionSchedule& schedule,
                            const MissionContext& context) {
  const auto station = std::find_if(
      context.stations.begin(), context.stations.end(), [&](const StationTeam& s) {
        return schedule.station.empty() || s.name == schedule.station;
      });
  if (station == context.stations.end())
    return Error{ErrorCode::kBadInput, "station",
                 fmt::format("there is no station \"{}\".", schedule.station), ""};
  const auto named = [&](const TeamAircraft& each, const std::string& name) {
    return each.name == name || each.group == name;
  };
  for (const std::string& name : schedule.aircraft)
    if (std::none_of(station->team.begin(), station->team.end(),
                     [&](const TeamAircraft& each) { return named(each, name); }))
      return Error{
          ErrorCode::kBadInput, "aircraft",
          fmt::format("the station has neither a group nor an aircraft \"{}\".", name),
          "Aircraft are called GROUP-1, GROUP-2, ..."};
  MissionTeam made{&*station, {}};
  std::vector<EntityId>& ids = made.candidates;
  for (const TeamAircraft& each : station->team) {
    const bool chosen =
        schedule.aircraft.empty() ||
        std::any_of(schedule.aircraft.begin(), schedule.aircraft.end(),
                    [&](const std::string& name) { return named(each, name); });
    const bool able = (!schedule.needs_camera || each.has_camera) &&
                      (!schedule.needs_fire_sensor || each.has_fire_sensor);
    if (chosen && able) ids.push_back(each.id);
  }
  if (ids.empty() && !station->team.empty())
    return Error{ErrorCode::kBadInput, "",
                 "none of the aircraft that it names has the sensors that it needs.", ""};
  return made;
}

std::unique_ptr<reasoning::PlannedMission> planned(const char* kind,
                                                   const MissionSchedule& schedule,
                                                   const MissionTeam& team,
                                                   std::unique_ptr<Mission> mission) {
  auto made = std::make_unique<reasoning::PlannedMission>();
  made->name = schedule.name.empty() ? kind : schedule.name;
  made->mission = std::move(mission);
  made->station = team.station->id;
  made->candidates = team.candidates;
  made->priority = schedule.priority;
  made->min = schedule.min;
  made->max = schedule.max;
  made->start = schedule.start;
  made->after = schedule.after;
  made->length = schedule.length;
  if (schedule.then == Afterwards::kReturn) made->then = ReturnHome{};
  if (schedule.then == Afterwards::kLand) made->then = LandAt{};
  return made;
}

}  // namespace skein::assemble
