// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "skein/base/id.h"
#include "skein/data/describe/describe.h"
#include "skein/geo/vec.h"
#include "skein/role/agent.h"

namespace my_kinds {

/// What aircraft say to each other: here the reading of one of them has changed.
struct SmokeNote {
  skein::Time time;
  skein::Vec2 place = skein::Vec2::Zero();  ///< [m]
  bool inside = false;
};

constexpr auto describe(const SmokeNote*) {
  using T = SmokeNote;
  return skein::described<T>(
      {"smoke_note"}, "The reading of an aircraft has changed.",
      skein::field("time", &T::time, "when"),
      skein::field("place", &T::place, skein::axes::kPlace, "where"),
      skein::field("inside", &T::inside, "it burns there"));
}

struct SmokeWatchOptions {
  double radius = 300;  ///< of the circle that it flies [m]
};

/// Circles about the origin and passes each change of its reading on: as a record, and as
/// a message to the other aircraft, which says in an event that it has received it.
class SmokeWatch final : public skein::Agent {
 public:
  /// @param self, other  of the two aircraft of a pair.
  SmokeWatch(const SmokeWatchOptions& options, skein::EntityId self,
             skein::EntityId other, double altitude_msl);

  void step(const skein::AgentInput& in, skein::AgentOutput& out) override;

 private:
  void note(const SmokeNote& note, skein::AgentOutput& out) const;

  SmokeWatchOptions options_;
  skein::EntityId self_, other_;
  double altitude_msl_;
  bool circles_ = false;
  std::optional<bool> inside_;
};

}  // namespace my_kinds
