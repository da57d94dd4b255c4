// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "skein/data/team/task.h"
#include "skein/data/team/task_needs.h"
#include "skein/data/team/team_message.h"
#include "skein/layer/reasoning/team/onboard/flight_conditions.h"

namespace skein::reasoning {

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
