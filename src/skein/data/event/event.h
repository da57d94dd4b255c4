// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "skein/base/id.h"
#include "skein/base/time.h"
#include "skein/data/describe/describe.h"

namespace skein {

/// Something worth reporting to the user that happened at one moment of a run.
struct Event {
  Time time;
  EntityId entity;
  std::string
      kind;  ///< short and stable, for scripts: "joined", "crossing", "outlier"...
  std::string text;  ///< for people
};

constexpr auto describe(const Event*) {
  using T = Event;
  return described<T>({"event", "events"}, "Something worth reporting.",
                      field("time", &T::time, "when"),
                      field("entity_id", &T::entity, "to whom it happened"),
                      field("kind", &T::kind, "short and stable, for scripts"),
                      field("text", &T::text, "for people"));
}

/// Whether an operator is to know of an event at once: alerts about other traffic that
/// rise or are over, paths that are recommended to pilots, allocations of a team that
/// wait for approval and what becomes of them, a real vehicle that is not what or where
/// it is to be, that is not taken off, or that cannot be commanded or brought back,
/// aircraft that come too near to each other.
inline bool is_announced(const Event& event) {
  return event.kind == "traffic-alert" || event.kind == "clear-of-traffic" ||
         event.kind == "recommended" || event.kind == "allocation-proposed" ||
         event.kind == "allocation-over" || event.kind == "wrong-vehicle" ||
         event.kind == "wrong-place" || event.kind == "not-heard" ||
         event.kind == "take-off-denied" || event.kind == "not-commandable" ||
         event.kind == "not-brought-back" || event.kind == "separation-lost";
}

}  // namespace skein
