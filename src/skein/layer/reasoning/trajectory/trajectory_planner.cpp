// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/trajectory/trajectory_planner.h"

#include <utility>

namespace skein::reasoning {

// What keeps a state from step to step: at the same place in both variants.
void TrajectoryPlanner::begin(const FlightIntent& intent) {
  progress_ = {};
  progress_.number = intent.number;
  if (std::holds_alternative<Circling>(intent.what))
    flight_.emplace<CirclingFlight>(context_);
  else if (const auto* legs = std::get_if<Legs>(&intent.what))
    flight_.emplace<RouteFlight>(*legs, context_);
  else if (const auto* itinerary = std::get_if<Itinerary>(&intent.what))
    flight_.emplace<PlanFlight>(*itinerary, context_);
  else if (const auto* landing = std::get_if<Landing>(&intent.what))
    flight_.emplace<LandingFlight>(*landing, context_);
  else if (std::holds_alternative<Returning>(intent.what))
    flight_.emplace<ReturnFlight>();
  else
    flight_.emplace<std::monostate>();
}

void TrajectoryPlanner::fly(const FlightIntent& intent, const TrajectoryStep& step,
                            AgentOutput& out) {
  if (intent.number != progress_.number || intent.what.index() != flight_.index())
    begin(intent);
  change_ = {};
  if (const auto* steering = std::get_if<Steering>(&intent.what)) {
    steer(*steering, context_, step, out);
    if (step.zones.deflecting()) change_ = "around zones by sight";
  } else if (auto* circling = std::get_if<CirclingFlight>(&flight_)) {
    circling->step(std::get<Circling>(intent.what), step, out);
    if (step.zones.deflecting()) change_ = "around zones by sight";
  } else if (auto* route = std::get_if<RouteFlight>(&flight_)) {
    route->step(step, out);
    route->report(progress_);
    change_ = route->change();
  } else if (auto* plan = std::get_if<PlanFlight>(&flight_)) {
    plan->step(step, out);
    plan->report(step.in, progress_);
    change_ = plan->change();
  } else if (auto* landing = std::get_if<LandingFlight>(&flight_)) {
    landing->step(step, out);
    progress_.done = landing->done(step.in);
  } else if (auto* back = std::get_if<ReturnFlight>(&flight_)) {
    progress_.done = back->commanded && step.in.autopilot.done;
    if (std::exchange(back->commanded, true)) return;
    AutopilotCommand command;
    command.guidance = Return{};
    command.altitude_msl = std::get<Returning>(intent.what).altitude_msl;
    out.command = std::move(command);
  }
}

}  // namespace skein::reasoning
