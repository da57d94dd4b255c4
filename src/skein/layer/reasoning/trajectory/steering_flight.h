// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "skein/layer/reasoning/trajectory/flight_context.h"
#include "skein/layer/reasoning/trajectory/flight_intent.h"
#include "skein/layer/reasoning/trajectory/trajectory_step.h"

namespace skein::reasoning {

/// Commands a momentary guidance: out of no-fly zones, and so high that the ground ahead
/// is cleared unless it says an altitude of its own.
void steer(const Steering& intent, const FlightContext& context,
           const TrajectoryStep& step, AgentOutput& out);

/// Circles a point, or the nearest place where no zone is in the way, named in an event
/// "task-moved".
class CirclingFlight {
 public:
  explicit CirclingFlight(const FlightContext& context) : context_(context) {}

  void step(const Circling& intent, const TrajectoryStep& step, AgentOutput& out);

 private:
  FlightContext context_;
  std::optional<Vec2> said_;   // the place that was taken instead, as last reported
  std::optional<Vec2> found_;  // the place where there is room instead
  Vec2 asked_ = Vec2::Zero();  // for which it was looked for
  bool clockwise_ = true;
};

/// Around a point, with room to correct in the wind.
Steering circle_at(const Vec2& centre, const NavEstimate& nav, const FlightLimits& limits,
                   bool clockwise = true);

/// The radius of turns over ground with room to correct in a wind [m].
double wide_radius(const FlightLimits& limits, const Vec2& wind);

}  // namespace skein::reasoning
