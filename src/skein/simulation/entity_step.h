#pragma once

#include <vector>

#include "skein/simulation/working_set.h"
#include "skein/simulation/world.h"

namespace skein::simulation {

/// What an entity keeps between the phases of a step.
struct EntityState {
  bool active = false;
  bool flew = false;                  ///< has been active before
  bool ended = false;                 ///< hit the ground: takes no further part
  std::vector<SensorSample> samples;  ///< of the payload, until the agent reads them
  /// Where those of each payload sensor in this step end, after those before `fresh`.
  std::size_t fresh = 0;
  std::vector<std::size_t> payload_ends;
  std::vector<SensorSample> flight_samples;  ///< of one step, kept for its memory
  enum class Accident { kNone, kGround, kNotFinite };
  Accident accident = Accident::kNone;  ///< in the last step
  VehicleState before;                  ///< at the start of the last step
  // What does not work now, as the vehicle's faults say.
  std::uint64_t silent_sensors = 0, silent_payload = 0;  ///< bit k: sensor k
  bool link_down = false;
  std::vector<bool> fault_active;  ///< of each of the vehicle's faults
  AutopilotStatus status;          ///< at the end of the last step
  AutopilotStatus told;            ///< the last status that was looked at
  std::vector<Message> inbox;
  AgentOutput output;
  std::uint64_t sent = 0;
};

/// Brings the vehicle's parts into the state that its faults want at `now`. Returns the
/// faults that have begun or ended, by index.
std::vector<std::size_t> update_faults(Time now, Entity& entity, EntityState& state);

/// The phases of one entity. Each reads the world and writes only `entity` and `state`.
void sense(const World& world, Time now, Entity& entity, EntityState& state);
void think(Time now, Entity& entity, EntityState& state);
/// From `now` to `until`, in the vehicle's own steps: control, motion, then what its
/// sensors say of the new state.
/// @param next  of the entity that flies next, to be loaded meanwhile; may be null.
void fly(const World& world, Time now, Time until, Entity& entity, EntityState& state,
         const WorkingSet* next);
/// What the vehicle's own sensors say before it first flies.
void begin(const World& world, Time now, Entity& entity, EntityState& state);

}  // namespace skein::simulation
