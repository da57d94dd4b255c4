// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "skein/base/id.h"
#include "skein/data/describe/describe.h"
#include "skein/geo/vec.h"

namespace skein {

/// How far a task of a team is.
enum class TeamTaskState : std::uint8_t {
  kWaits,      ///< for tasks that it comes after
  kOpen,       ///< nobody flies it yet
  kFlown,      ///< somebody does
  kDone,       ///< nothing is left of it
  kWithdrawn,  ///< the operator does not want it any more
};
constexpr auto names_of(const TeamTaskState*) {
  return std::array<std::string_view, 5>{"waits", "open", "flown", "done", "withdrawn"};
}

/// A task of a team that leads itself, as its operator's station has heard.
struct TeamTaskReport {
  std::string team;                       ///< its mission
  std::uint32_t number = 0;               ///< among the mission's, from 1
  std::string what;                       ///< its kind
  Vec2 place = Vec2::Zero();              ///< its centre, N [m]
  std::vector<std::uint32_t> after = {};  ///< tasks that are over before it is flown
  bool group = false;                     ///< several may fly it at once
  TeamTaskState state = TeamTaskState::kOpen;
  std::optional<EntityId> executor = std::nullopt;  ///< who flies it; of several one
  friend bool operator==(const TeamTaskReport&, const TeamTaskReport&) = default;
};

constexpr auto describe(const TeamTaskReport*) {
  using T = TeamTaskReport;
  return described<T>(
      {"team_task_report"}, "A task of a team, as its operator's station has heard.",
      field("team", &T::team, "its mission"),
      field("number", &T::number, "among the mission's, from 1"),
      field("what", &T::what, "its kind"),
      field("", &T::place, axes::kPlace, "its centre"),
      field("after", &T::after, Storage::kJson, "tasks that are over before it is flown"),
      field("several", &T::group, "several may fly it at once"),
      field("state", &T::state, "how far it is"),
      field("executor_id", &T::executor, "who flies it; null: nobody"));
}

}  // namespace skein
