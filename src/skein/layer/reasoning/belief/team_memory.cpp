// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/belief/team_memory.h"

namespace skein::reasoning {

void TeamMemory::listen(const AgentInput& in) {
  const auto take = [&](EntityId id, const NavEstimate& nav) {
    const auto [at, first] = members_.try_emplace(id, nav);
    if (!first && nav.time > at->second.time) at->second = nav;
  };
  for (const Message& message : in.inbox) {
    if (const auto* position = std::get_if<TeamPosition>(&message.content))
      take(position->aircraft, position->nav);
    else if (const auto* report = std::get_if<AircraftReport>(&message.content))
      take(message.from, report->nav);
  }
}

std::optional<NavEstimate> TeamMemory::find(EntityId id) const {
  const auto found = members_.find(id);
  if (found == members_.end()) return std::nullopt;
  return found->second;
}

}  // namespace skein::reasoning
