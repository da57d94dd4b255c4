// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "skein/base/id.h"
#include "skein/base/time.h"
#include "skein/data/describe/describe.h"
#include "skein/data/event/event_kind.h"

namespace skein {

/// Numbers of an event, for programs. Which of them a kind has, and what they are, its
/// row says.
struct EventNumbers {
  std::optional<EntityId> other = std::nullopt;           ///< whom else it concerns
  std::optional<std::uint32_t> task = std::nullopt;       ///< of an order
  std::optional<std::uint32_t> team_task = std::nullopt;  ///< of a team's mission
  std::optional<double> value = std::nullopt;
  std::optional<double> threshold = std::nullopt;  ///< that the value is compared with

  friend bool operator==(const EventNumbers&, const EventNumbers&) = default;
};

constexpr auto describe(const EventNumbers*) {
  using T = EventNumbers;
  return described<T>(
      {"event_numbers"}, "Numbers of an event; docs/events.md says which a kind has.",
      field("other_id", &T::other, "whom else it concerns"),
      field("task", &T::task, "number of a task that was ordered"),
      field("team_task", &T::team_task, "number of a task of a team"),
      field("value", &T::value, "as the kind has it"),
      field("threshold", &T::threshold, "that the value is compared with"));
}

/// Something worth reporting that happened at one moment of a run.
struct Event {
  Time time;
  EntityId entity;
  EventLabel kind;
  std::string text;  ///< for people: programs take `kind` and `numbers`
  EventNumbers numbers = {};
};

constexpr auto describe(const Event*) {
  using T = Event;
  return described<T>({"event", "events"}, "Something worth reporting.",
                      field("time", &T::time, "when"),
                      field("entity_id", &T::entity, "to whom it happened"),
                      field("kind", &T::kind, "short and stable: docs/events.md"),
                      field("text", &T::text, "for people"),
                      // What counts of them stands in the text too.
                      unhashed(field("", &T::numbers, "for programs")));
}

/// Whether whoever commands is to know of an event at once, as its kind's row says.
inline bool is_announced(const Event& event) {
  return row_of(event.kind.kind()).announced;
}

}  // namespace skein
