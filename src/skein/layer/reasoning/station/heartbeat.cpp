// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/station/heartbeat.h"

#include <algorithm>

namespace skein::reasoning {

void HeartbeatSender::step(Time now, AgentOutput& out) {
  if (period_ == Time() || now < next_) return;
  next_ = std::max(next_ + period_, now);
  for (const EntityId id : team_)
    out.outbox.push_back({EntityId{}, id, 0, Time(), Heartbeat{}});
}

}  // namespace skein::reasoning
