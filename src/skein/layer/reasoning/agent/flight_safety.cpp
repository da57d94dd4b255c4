// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/agent/flight_safety.h"

#include <utility>

namespace skein::reasoning {
bool FlightSafety::may_fly(const AgentInput& in, double altitude_msl, bool may_stand,
                           AgentOutput& out) {
  if (!home_) {
    home_ = geo::horizontal(in.nav->p_N);
    began_on_ground_ = in.autopilot.on_ground;
  }
  returns_.step(in, *home_, zones_.zones(), news_, out);
  if (may_stand && in.autopilot.on_ground) return true;
  return !zones_.keeps_on_ground(in, altitude_msl) &&
         !launch_.takes_off(in, altitude_msl, out);
}

void FlightSafety::finish(const AgentInput& in, AgentOutput& out) {
  zones_.look(in, out);
  if (auto event = execution_.check(in.now, self_, in.autopilot))
    out.events.push_back(*std::move(event));
}

}  // namespace skein::reasoning
