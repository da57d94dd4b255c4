#include "simulation/entity_step.h"

namespace skein::simulation {

void sense(const World& world, Time now, Entity& entity, EntityState& state) {
  Vehicle* vehicle = entity.vehicle.get();
  if (!state.active || !vehicle) return;
  const SensorView view{now, vehicle->state, *world.terrain, *world.fire};
  for (const auto& sensor : vehicle->sensors) sensor->sample(view, state.samples);
  for (; state.sensed < state.samples.size(); ++state.sensed)
    vehicle->autopilot->sense(state.samples[state.sensed]);
}

void think(Time now, Entity& entity, EntityState& state) {
  if (!state.active || now.ns() % entity.agent_period.ns() != 0) return;
  AgentInput in;
  in.now = now;
  if (entity.vehicle) {
    in.nav = &entity.vehicle->autopilot->estimate();
    in.autopilot = entity.vehicle->autopilot->status();
  }
  in.samples = state.samples;
  in.inbox = state.inbox;
  entity.agent->step(in, state.output);
  if (state.output.command && entity.vehicle)
    entity.vehicle->autopilot->command(*state.output.command);
  state.output.command.reset();
  state.samples.clear();
  state.sensed = 0;
  state.inbox.clear();
}

void fly(const World& world, Time now, double dt, Entity& entity, EntityState& state) {
  Vehicle* vehicle = entity.vehicle.get();
  if (!state.active || !vehicle) return;
  const FlightCommand command = vehicle->autopilot->control(now, dt);
  Air air;
  air.wind_N = world.wind->wind(vehicle->state.p_N, now);
  vehicle->state = vehicle->plant->step(vehicle->state, command, air, dt);
}

}  // namespace skein::simulation
