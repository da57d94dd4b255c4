#pragma once

#include <vector>

#include "simulation/world.h"

namespace skein::simulation {

/// What an entity keeps between the phases of a step.
struct EntityState {
  bool active = false;
  bool ended = false;  ///< hit the ground: takes no further part
  std::vector<SensorSample> samples;
  std::size_t sensed = 0;  ///< samples that the autopilot has had
  std::vector<Message> inbox;
  AgentOutput output;
  std::uint64_t sent = 0;
};

/// The phases of one entity. Each reads the world and writes only `entity` and `state`.
void sense(const World& world, Time now, Entity& entity, EntityState& state);
void think(Time now, Entity& entity, EntityState& state);
void fly(const World& world, Time now, double dt, Entity& entity, EntityState& state);

}  // namespace skein::simulation
