// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "skein/base/id.h"
#include "skein/base/result.h"

namespace skein::rehearsal {

/// What happens to a team in a rehearsal.
struct TeamScriptEvent {
  enum class What : std::uint8_t { kCrash, kJoin, kPartition, kHeal };
  What what = What::kCrash;
  double time = 0;                                ///< [s]
  EntityId aircraft = {};                         ///< that crashes or joins
  std::vector<std::vector<EntityId>> parts = {};  ///< no message passes between them
};
constexpr auto names_of(const TeamScriptEvent::What*) {
  return std::array<std::string_view, 4>{"crash", "join", "partition", "heal"};
}

/// A team that leads a group.
struct TeamGroup {
  EntityId master;
  std::vector<EntityId> members;  ///< ascending
  std::string mission;            ///< M, or M/<id> once it was split
  friend auto operator<=>(const TeamGroup&, const TeamGroup&) = default;
};

/// The teams that there must be at a time.
struct TeamExpectation {
  double time = 0;                ///< [s]
  std::vector<TeamGroup> groups;  ///< ascending
};

/// A rehearsal: who is there at the start, with mission M, and what happens.
struct TeamScript {
  std::string id;
  std::vector<EntityId> aircraft;
  std::uint32_t tasks = 0;
  std::vector<TeamScriptEvent> events;  ///< in the order of their times
  std::vector<TeamExpectation> expect;
  double end = 0;  ///< [s]
};

/// Reads a list of scripts; see docs/team.md.
/// @param name  of the text, for messages.
/// Fails: kBadInput, with up to 20 problems and their places: unknown or missing keys,
///        ids twice, events out of order or of aircraft that are not there, more than
///        100 aircraft, 1000 tasks, 100 events, 10,000 s or 10,000 scripts.
Result<std::vector<TeamScript>> read_team_scripts(std::string_view text,
                                                  const std::string& name);

}  // namespace skein::rehearsal
