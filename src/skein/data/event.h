#pragma once

#include <string>

#include "skein/base/id.h"
#include "skein/base/time.h"
#include "skein/data/describe.h"

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

}  // namespace skein
