// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "skein/layer/reasoning/trajectory/flight_context.h"
#include "skein/layer/reasoning/trajectory/flight_intent.h"
#include "skein/layer/reasoning/trajectory/trajectory_step.h"

namespace skein::reasoning {

/// Lands at a place or, while zones forbid it, at the nearest one that they do not, named
/// in an event "return-moved".
class LandingFlight {
 public:
  LandingFlight(const Landing& landing, const FlightContext& context)
      : landing_(landing), self_(context.self), map_(*context.map) {}

  void step(const TrajectoryStep& step, AgentOutput& out);

  /// It stands on the ground, having been commanded to land.
  bool done(const AgentInput& in) const { return commanded_ && in.autopilot.on_ground; }

 private:
  Landing landing_;
  EntityId self_;
  const Terrain& map_;
  std::optional<Vec2> commanded_;  // where to
};

}  // namespace skein::reasoning
