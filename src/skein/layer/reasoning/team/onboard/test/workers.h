// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/layer/reasoning/team/onboard/task_needs.h"
#include "skein/layer/reasoning/team/protocol/allocation.h"

namespace skein::reasoning {

/// An aircraft of 20 m/s that can fly for ten hours, and whose home is the origin.
inline TeamWorker worker(std::uint32_t id, const Vec2& place, std::uint32_t sensors = 0) {
  TeamWorker made;
  made.id = EntityId{id};
  made.resources.place = {place.x(), place.y(), -100};
  made.resources.speed = 20;
  made.resources.endurance = 36000;
  made.resources.sensors = sensors;
  return made;
}

inline TeamTask measure(std::uint32_t number, const Vec2& place, double stay = 30,
                        std::uint32_t sensors = 0) {
  return team_task(number, Measure{place, stay}, sensors, false);
}

}  // namespace skein::reasoning
