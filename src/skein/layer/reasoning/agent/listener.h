#pragma once

#include "skein/role/agent.h"

namespace skein::reasoning {

/// A ground station's agent that takes in what it receives and does nothing.
class Listener final : public Agent {
 public:
  void step(const AgentInput&, AgentOutput&) override {}
};

}  // namespace skein::reasoning
