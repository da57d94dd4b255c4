// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>
#include <variant>

#include "skein/layer/reasoning/trajectory/flight_context.h"
#include "skein/layer/reasoning/trajectory/flight_intent.h"
#include "skein/layer/reasoning/trajectory/landing_flight.h"
#include "skein/layer/reasoning/trajectory/plan_flight.h"
#include "skein/layer/reasoning/trajectory/route_flight.h"
#include "skein/layer/reasoning/trajectory/steering_flight.h"

namespace skein::reasoning {

/// The last planner of the chain: makes of what shall be flown a command to the autopilot
/// that keeps out of no-fly zones, above the ground and within what the aircraft can do.
class TrajectoryPlanner {
 public:
  /// @param context  outlives it.
  explicit TrajectoryPlanner(const FlightContext& context) : context_(context) {}

  /// To be called at each step in which the aircraft may fly. May command.
  void fly(const FlightIntent& intent, const TrajectoryStep& step, AgentOutput& out);

  /// How the flight of the last intent goes.
  const FlightProgress& progress() const { return progress_; }

  /// Why what is flown is not the intent; empty: it is.
  std::string_view change() const { return change_; }

 private:
  struct ReturnFlight {
    bool commanded = false;
  };
  void begin(const FlightIntent& intent);

  const FlightContext& context_;
  std::variant<std::monostate, CirclingFlight, RouteFlight, PlanFlight, LandingFlight,
               ReturnFlight>
      flight_;
  FlightProgress progress_;
  std::string_view change_;
};

}  // namespace skein::reasoning
