// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>

#include "skein/data/team/task.h"
#include "skein/data/vehicle/agent_step.h"

namespace skein::reasoning {

/// Says to aircraft how high and how fast to fly, again until each says that it knows.
class FlightChanges {
 public:
  /// What was ordered before and is not confirmed yet is said with it.
  void order(EntityId aircraft, const FlightChange& change, Time now, AgentOutput& out);
  void confirm(EntityId aircraft, const FlightChange& flown);
  void resend(Time now, AgentOutput& out);

 private:
  struct Order {
    FlightChange change;
    bool confirmed = false;
    Time sent;
  };
  static void send(EntityId aircraft, Order& order, Time now, AgentOutput& out);

  std::map<EntityId, Order> orders_;
};

}  // namespace skein::reasoning
