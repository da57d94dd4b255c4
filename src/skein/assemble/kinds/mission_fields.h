// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "skein/assemble/kinds/contexts.h"
#include "skein/layer/reasoning/station/mission_control.h"
#include "skein/scenario/fields.h"

namespace skein::assemble {

/// What aircraft of a mission fly when it is over.
enum class Afterwards { kHold, kReturn, kLand };

/// When a mission is flown, and by whom: keys of every kind of mission.
struct MissionSchedule {
  std::string name;  ///< empty: as its kind is called
  std::string station;
  std::vector<std::string> aircraft;
  bool needs_camera = false, needs_fire_sensor = false;
  int priority = 0;
  std::optional<int> min, max;
  std::optional<Time> start = Time();
  std::string after;
  std::optional<Time> length;
  Afterwards then = Afterwards::kHold;
};

/// Adds the keys of the schedule to those of a kind of mission.
/// @tparam T  the kind's options, derived from MissionSchedule.
template <class T>
scenario::Fields<T> with_schedule(scenario::Fields<T> fields) {
  return std::move(fields)
      .text("name", &T::name, "What it is called, for commands. Empty: as its kind.")
      .text("station", &T::station,
            "Ground station that pursues it, with its aircraft. Empty: the first.")
      .text("aircraft", &T::aircraft,
            "Who may fly it: names of groups or aircraft. Empty: all of the station.")
      .items({.at_most = 10000})
      .boolean("needs_camera", &T::needs_camera, "Only aircraft with a camera may.")
      .boolean("needs_fire_sensor", &T::needs_fire_sensor,
               "Only aircraft with a fire sensor may.")
      .integer("priority", &T::priority,
               "Larger is more important where missions want the same aircraft.",
               {.at_least = -1000, .at_most = 1000})
      .integer("min_aircraft", &T::min,
               "It takes so many from less important missions. Null: as its kind needs.",
               {.at_least = 0, .at_most = 10000})
      .integer("max_aircraft", &T::max,
               "Not more are given to it. Null: as many as its kind has a use for.",
               {.at_least = 0, .at_most = 10000})
      .duration_s("start_s", &T::start,
                  "When it begins. Null: on the command `mission start`.",
                  {.at_least = 0})
      .text("after", &T::after,
            "It begins when the mission of this name is over, instead.")
      .duration_s("length_s", &T::length, "How long it lasts. Null: until it is done.",
                  {.above = 0})
      .word("then", &T::then, "What its aircraft do when it is over.",
            {{"hold", Afterwards::kHold, "they stay where they are"},
             {"return", Afterwards::kReturn, "they fly home and stay above"},
             {"land", Afterwards::kLand, "they land at home"}});
}

/// The station that pursues a mission, and the aircraft that may fly it.
struct MissionTeam {
  const StationTeam* station = nullptr;
  std::vector<EntityId> candidates;
};

/// Fails: kBadInput for a name that no station, no aircraft and no group has, and when
///        no aircraft may fly it.
Result<MissionTeam> team_of(const MissionSchedule& schedule,
                            const MissionContext& context);

/// A mission with its schedule.
/// @param kind  its name where the schedule has none.
std::unique_ptr<reasoning::PlannedMission> planned(const char* kind,
                                                   const MissionSchedule& schedule,
                                                   const MissionTeam& team,
                                                   std::unique_ptr<Mission> mission);

}  // namespace skein::assemble
