// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/data/vehicle/agent_step.h"

namespace skein {

/// The reasoning of one entity. It never learns whether its vehicle is real.
class Agent {
 public:
  virtual ~Agent() = default;

  /// Thinks once; appends to `out`.
  virtual void step(const AgentInput& in, AgentOutput& out) = 0;
};

}  // namespace skein
