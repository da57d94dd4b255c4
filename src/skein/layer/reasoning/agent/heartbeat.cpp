#include "skein/layer/reasoning/agent/heartbeat.h"

#include <algorithm>

#include "skein/base/check.h"

namespace skein::reasoning {
HeartbeatSender::HeartbeatSender(std::unique_ptr<Agent> station,
                                 std::vector<EntityId> team, Time period)
    : station_(std::move(station)), team_(std::move(team)), period_(period) {
  SKEIN_CHECK(period > Time());
}

void HeartbeatSender::step(const AgentInput& in, AgentOutput& out) {
  station_->step(in, out);
  if (in.now < next_) return;
  next_ = std::max(next_ + period_, in.now);
  for (const EntityId id : team_)
    out.outbox.push_back({EntityId{}, id, 0, Time(), Heartbeat{}});
}

}  // namespace skein::reasoning
