// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "skein/layer/reasoning/trajectory/flight_context.h"
#include "skein/layer/reasoning/trajectory/flight_intent.h"
#include "skein/layer/reasoning/trajectory/trajectory_step.h"

namespace skein::reasoning {

/// Flies a plan as it is, as long as nothing is in its way.
///
/// Where a no-fly zone comes to lie on the rest of the plan, or the aircraft has left it,
/// the plan is mended leg by leg: left for a while and joined again before the next
/// milestone that is not blocked; what comes after is flown that much later
/// (solve::repair). Where no mending is found, the zone avoidance leads the aircraft
/// along the plan by sight, and mending is tried again ten seconds later, then less and
/// less often. An aircraft within a zone leaves it first. A plan that the autopilot
/// refuses is not flown any more: who has made it must make another.
class PlanFlight {
 public:
  /// @param itinerary  its plan is not empty; milestones end with the plan.
  PlanFlight(const Itinerary& itinerary, const FlightContext& context);

  void step(const TrajectoryStep& step, AgentOutput& out);

  void report(const AgentInput& in, FlightProgress& progress) const;

  /// What it does with its plan, for the records; empty: it flies it as it was given.
  std::string_view change() const;

 private:
  enum class State { kNew, kAsPlanned, kMended, kBySight, kRefused };

  void look(const TrajectoryStep& step, AgentOutput& out);
  bool blocked(const TrajectoryStep& step) const;
  void catch_up(const AgentInput& in);
  bool mend(const TrajectoryStep& step, AgentOutput& out);
  void give(const TrajectoryStep& step, AgentOutput& out);
  double distance_to_plan(const Vec2& place) const;
  void lead_by_sight(const TrajectoryStep& step, AgentOutput& out);
  double altitude_msl(double time) const;

  FlightPlan plan_;                 // as it is flown
  std::vector<double> milestones_;  // those that it still meets, and met since
  std::size_t total_;               // milestones of the itinerary
  bool in_time_, rejoins_, over_ground_;
  FlightContext context_;
  State state_ = State::kNew;
  Plan given_;  // to the autopilot
  Time given_at_, look_again_;
  double wait_ = 0;       // after the last failure to mend [s]
  bool changed_ = false;  // it is not flown as it was given
};

}  // namespace skein::reasoning
