#pragma once

#include <cstdint>
#include <optional>

#include "skein/data/task.h"
#include "skein/data/team_message.h"

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
TeamTask team_task(std::uint32_t number, const TaskKind& what, std::uint32_t sensors,
                   bool group);

/// Time of a straight flight in wind.
///
///   leg / (w_along + sqrt(V^2 - w_across^2))
///
/// @param speed  through the air [m/s].
/// @returns  [s]; none: it does not get there against the wind.
std::optional<double> time_in_wind(const Vec2& leg, double speed, const Vec2& wind);

/// How long an aircraft flies straight to where a task begins.
/// @param wind  as believed [m/s].
/// @returns  [s]; none: it does not get there against the wind.
std::optional<double> time_to_begin(const TaskNeeds& needs,
                                    const TeamResources& resources, const Vec2& wind);

/// How long it needs for the task itself; without an end an hour counts.
/// @returns  [s]; none: the wind is too strong.
std::optional<double> time_within(const TaskNeeds& needs, const TeamResources& resources,
                                  const Vec2& wind);

}  // namespace skein::reasoning
