// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/team/protocol/team_config.h"

namespace skein::reasoning {

EntityId lowest_id(std::span<const EntityId> ids) {
  return ids.front();
}

double nearness(const TeamTask& task, const TeamResources& self,
                std::span<const TeamTask> bundle) {
  constexpr double kFar = 1000;  // [m]
  const Vec2 from = bundle.empty() ? geo::horizontal(self.place) : bundle.back().place;
  return 1 / (1 + (task.place - from).norm() / kFar);
}

}  // namespace skein::reasoning
