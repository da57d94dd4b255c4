// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <oneapi/tbb/task_arena.h>

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "skein/base/result.h"
#include "skein/role/radio.h"
#include "skein/role/recorder.h"
#include "skein/role/vehicle.h"
#include "skein/simulation/entity_state.h"
#include "skein/simulation/object_motions.h"
#include "skein/simulation/payload_tap.h"
#include "skein/simulation/run_options.h"
#include "skein/simulation/separation_monitor.h"
#include "skein/simulation/step_recorder.h"
#include "skein/simulation/traffic_motions.h"
#include "skein/simulation/world.h"

namespace skein::simulation {

/// One run: the world, what is between the phases of a step, and where it is recorded.
///
/// A phase in which entities run in parallel writes only their own state; what they say
/// to others is merged in entity order.
class Stepper {
 public:
  Stepper(World& world, const RunOptions& options, Recorder& recorder);

  /// Records what exists. Before the first step.
  void introduce() { records_.introduce(); }

  /// Takes a command that counts from `now` on, and records it. Those that steer the
  /// clock are the caller's to obey.
  /// Fails: kBadInput when it cannot be obeyed, which is recorded too.
  Result<void> command(Time now, std::string sender, const Command& command);

  /// Moves the world from `now` to the next step.
  Result<void> step(Time now);

  /// Records what is left to record after the last step.
  void finish();

  /// Events since the last call that an operator is to know of at once.
  std::vector<Event> take_announcements() { return records_.take_announcements(); }
  std::string_view name_of_entity(EntityId id) const {
    return records_.name_of_entity(id);
  }

  /// Whether an entity takes part, or has done so.
  bool has_begun(EntityId id) const { return states_[id.value].begun; }

  /// The key figure of the newest belief, in a few words; empty without one.
  std::string headline() const { return records_.headline(); }

 private:
  void move_objects(Time now);
  void move_traffic(Time now);
  void update_presence(Time now);
  void update_parts(Time now);
  void record_reports(Time now, std::size_t i);
  void look(Time now);
  void log_payload_samples(Time now);
  void log_payload_samples(Time now, std::size_t i);
  void record_memory();
  void think(Time now);
  void think(Time now, std::size_t i);
  void exchange(Time now);
  void send(Time now, std::size_t i);
  void send_to_all(Message message, bool works);
  void send(const Message& message, bool works);
  void receive(Time now);
  void advance(Time now, Time until);
  void record_accidents(Time now);
  void watch_separation(Time now);
  void record_status_changes(Time now);
  std::optional<std::size_t> find(const std::string& aircraft) const;
  bool is_station(const std::string& name) const;
  bool will_take_part(std::size_t i, Time now) const;
  void obey(Time now, const Command& command);
  void refuse(Time now, const std::string& why);
  template <class Body>
  void for_each(Body body);  // body(i) for every entity
  Surroundings surroundings(std::size_t i) const;

  World& world_;
  const RunOptions& options_;
  Recorder& recorder_;
  StepRecorder records_;
  oneapi::tbb::task_arena arena_;
  ObjectMotions objects_;
  std::vector<Vec3> aircraft_places_, physical_places_;
  TrafficMotions traffic_;
  std::vector<VisibleAircraft> visible_aircraft_;  // that take part
  PayloadTap tap_;
  std::vector<ObservationRecord> observations_;
  std::vector<Event> memory_events_;
  std::vector<const Phenomenon*> phenomena_;
  std::vector<EntityState> states_;
  SeparationMonitor separation_;
  RadioNews news_;
  std::vector<VehicleEvent> vehicle_events_;
  std::vector<VehicleReport> vehicle_reports_;
  Time last_step_;
  std::optional<std::string> refusal_;  // why the last command cannot be obeyed
};

}  // namespace skein::simulation
