// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "skein/layer/reasoning/agent/task_executor.h"
#include "skein/layer/reasoning/avoidance/landing/landing_queue.h"
#include "skein/layer/reasoning/trajectory/flight_context.h"

namespace skein::reasoning {

/// How well the others of the team are heard.
struct RadioQuality {
  double loss = 0;   ///< share of what they send that does not arrive
  double delay = 0;  ///< of what arrives, the longest of late [s]
};

/// Lands one after the other with others that land at the same place (LandingQueue).
///
/// An aircraft that wants to land flies to a holding circle upwind of the place and waits
/// there, at its own height, until it has its turn; then at that height to where the
/// approach begins, and only from there on down, so that it crosses nobody's height. What
/// a failsafe lands is said to the others, who leave the place to it.
class LandingPlanner {
 public:
  /// @param context      outlives it.
  /// @param horizontal   separation that is kept [m].
  /// @param level_step   between the heights of two that wait [m].
  LandingPlanner(const FlightContext& context, double horizontal, double level_step)
      : context_(context), horizontal_(horizontal), queue_(context.self, level_step) {}

  /// Takes in what others say; on the ground, having flown, says that it has landed. At
  /// each step.
  void listen(const AgentInput& in, const RadioQuality& radio, AgentOutput& out);

  /// At each step in the air.
  /// @returns  `given` itself, or what is flown instead of a landing, good until the next
  ///           call.
  const FlightIntent* plan(const FlightIntent* given, const TaskStep& step,
                           const RadioQuality& radio, AgentOutput& out);

  /// It is on its approach: it has the right of way, and is not led another way.
  bool approaches() const { return leg_ == Leg::kApproach; }

  /// Why it does not fly what it was given; empty: it does. Lives as long as the program.
  std::string_view reason() const { return reason_; }

 private:
  enum class Leg { kNone, kHold, kToApproach, kApproach };

  const FlightIntent* fly(const LandingTurn& turn, const TaskStep& step,
                          AgentOutput& out);
  void begin(Leg leg, const TaskStep& step, AgentOutput& out);
  void leave(AgentOutput& out);
  double approach_length() const;
  double time_needed(const LandingTurn& turn, const NavEstimate& nav) const;
  void send(AgentOutput& out);

  const FlightContext& context_;
  double horizontal_;
  LandingQueue queue_;
  Leg leg_ = Leg::kNone;
  Vec2 place_ = Vec2::Zero();  // where it lands [m]
  double ground_ = 0;          // there, above mean sea level [m]
  LandingTurn turn_;           // the last one
  FlightIntent own_;
  bool has_flown_ = false;
  std::string_view reason_;
  std::vector<Message> messages_;
};

}  // namespace skein::reasoning
