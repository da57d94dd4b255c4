#pragma once

#include "skein/data/agent_step.h"

namespace skein {

struct BoundaryEstimate;

/// The reasoning of one entity. It never learns whether its vehicle is real.
class Agent {
 public:
  virtual ~Agent() = default;

  /// Thinks once; appends to `out`.
  virtual void step(const AgentInput& in, AgentOutput& out) = 0;

  /// What this agent believes about the perimeter; null when it keeps no such belief.
  virtual const BoundaryEstimate* perimeter() const { return nullptr; }
};

}  // namespace skein
