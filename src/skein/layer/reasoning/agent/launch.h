// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "skein/data/vehicle/agent_step.h"

namespace skein::reasoning {

/// Gets an aircraft off the ground before its agent's own flight begins.
class Launch {
 public:
  /// Call at every step, before any other command.
  ///
  /// An aircraft that stands on the ground at the first step is commanded to take off
  /// along its heading after five seconds of rest, again while it still stands (a
  /// failsafe may have forbidden it), and is under way until it has reached the altitude.
  ///
  /// @param altitude  to climb to [m above mean sea level].
  /// @returns         whether it is still being done; then nothing else may be commanded.
  bool takes_off(const AgentInput& in, double altitude, AgentOutput& out);

  /// An aircraft that stands on the ground, having flown before, may take off again.
  void allow(const AgentInput& in) {
    if (in.autopilot.on_ground && state_ == State::kFlies) state_ = State::kNew;
  }

 private:
  enum class State { kNew, kTakesOff, kFlies };
  State state_ = State::kNew;
  Time order_at_;
};

}  // namespace skein::reasoning
