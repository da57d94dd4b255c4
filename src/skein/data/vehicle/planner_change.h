// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "skein/data/describe/describe.h"

namespace skein {

/// The planners on board, in the order in which they hand on what shall be flown.
enum class PlannerLink : std::uint8_t {
  kLoiter,      ///< a circle that can always be flown
  kTask,        ///< what the task needs
  kSeparation,  ///< out of the way of others
  kTrajectory,  ///< in the wind, around zones, above the ground
};
constexpr auto names_of(const PlannerLink*) {
  return std::to_array<std::string_view>({"loiter", "task", "separation", "trajectory"});
}
inline constexpr int kPlannerLinks = 4;

/// What a planner did with what it was handed.
enum class PlannerVerdict : std::uint8_t { kPassedOn, kModified, kReplaced };
constexpr auto names_of(const PlannerVerdict*) {
  return std::to_array<std::string_view>({"passed-on", "modified", "replaced"});
}

/// From now on a planner does something else with what it is handed.
struct PlannerChange {
  PlannerLink link = PlannerLink::kLoiter;
  PlannerVerdict verdict = PlannerVerdict::kPassedOn;
  std::string reason;  ///< for people; empty when there is nothing to say
};

constexpr auto describe(const PlannerChange*) {
  using T = PlannerChange;
  return described<T>(
      {"planner_change"}, "A planner on board does something else from now on.",
      field("link", &T::link, "which planner of the chain"),
      field("verdict", &T::verdict, "what it does with what it is handed"),
      field("reason", &T::reason, "why"));
}

}  // namespace skein
