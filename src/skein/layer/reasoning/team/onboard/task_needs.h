// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "skein/data/team/task.h"
#include "skein/data/team/team_message.h"
#include "skein/layer/reasoning/team/onboard/flight_conditions.h"

namespace skein::reasoning {

/// Bits of TeamResources::sensors and TeamTask::sensors.
enum TeamSensors : std::uint32_t {
  kCameraSensor = 1,
  kFireSensor = 2,
  kHovers = 4,  ///< no sensor: it can stay at a place
};

/// What a task takes of an aircraft that flies it alone.
struct TaskNeeds {
  std::optional<Vec2> begin = {};  ///< where it begins, N [m]; none: anywhere
  std::optional<Vec2> end = {};    ///< where it ends, N [m]; none: where it begins
  Vec2 centre = Vec2::Zero();      ///< of it, N [m]; of no place: the origin
  double length = 0;               ///< of the flight within it [m]
  double stay = 0;                 ///< besides [s]
  bool endless = false;            ///< until another order
  std::uint32_t sensors = 0;       ///< without which it cannot be flown
  bool better_hovering = false;    ///< about one place
};

/// From what the task says. Lengths are of straight legs; of a survey the area over the
/// distance of its lines.
TaskNeeds needs_of(const TaskKind& task);

/// Of a task that a team has; nothing is known of what cannot be read but its place.
TaskNeeds needs_of(const TeamTask& task);

/// The task as a team is given it.
/// @param number   among the mission's, from 1.
/// @param sensors  that it takes besides.
/// @param group    several may fly it at once.
/// @param after    numbers of tasks that are over before it is flown.
TeamTask team_task(std::uint32_t number, const TaskKind& what, std::uint32_t sensors,
                   bool group, std::vector<std::uint32_t> after = {});

/// Whether an aircraft has the sensors that a task takes, and has not refused it.
bool may_be_given(const TeamTask& task, const TeamResources& resources);

/// How long an aircraft flies to where a task begins.
/// @returns  [s]; none: it does not get there against the wind.
std::optional<double> time_to_begin(const TaskNeeds& needs,
                                    const TeamResources& resources,
                                    const FlightConditions& conditions);

/// How long it needs for the task itself; without an end an hour counts.
/// @returns  [s]; none: the wind is too strong.
std::optional<double> time_within(const TaskNeeds& needs, const TeamResources& resources,
                                  const FlightConditions& conditions);

/// How long it flies home from where a task ends.
/// @returns  [s]; none: it does not get there against the wind.
std::optional<double> time_home(const TaskNeeds& needs, const TeamResources& resources,
                                const FlightConditions& conditions);

/// The endurance that an aircraft is to have over the time that a task takes it, there
/// and home.
inline constexpr double kEnduranceReserve = 1.2;

}  // namespace skein::reasoning
