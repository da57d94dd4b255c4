// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "skein/data/event/agent_record.h"
#include "skein/data/event/event.h"
#include "skein/role/radio.h"
#include "skein/role/recorder.h"
#include "skein/simulation/entity_state.h"
#include "skein/simulation/separation_monitor.h"
#include "skein/simulation/world.h"

namespace skein::simulation {

/// What a step leaves in the records of a run: records of what is and was said, events,
/// and the few figures of a run that an operator sees while it goes on.
class StepRecorder {
 public:
  /// @param world, recorder  outlive it.
  StepRecorder(const World& world, Recorder& recorder)
      : world_(world), recorder_(recorder) {}

  /// Entities, objects, traffic and zones as the run begins.
  void introduce();

  /// Truth and estimate of all vehicles that take part.
  void vehicles(std::span<const EntityState> states, Time now);

  /// What the radios have carried since the last call.
  void radios(std::span<const EntityState> states, Time now);
  /// When radios() was called last.
  Time radios_recorded() const { return radios_recorded_; }

  /// What the agent of entity `i` wants recorded.
  void agent(Time now, std::size_t i, const AgentRecord& said);

  /// What became of a message, at `ended`.
  void message(const MessageOutcome& outcome, Time ended);

  /// Losses of separation that have begun or are over.
  void separation(const SeparationMonitor& monitor);

  /// What the autopilot of entity `i` does by itself: modes and failsafes, sensors,
  /// take-offs and landings. What has been recorded is noted in `state`.
  void status_changes(Time now, std::size_t i, EntityState& state);

  /// An event of entity `i`.
  void event(Time now, std::size_t i, EventLabel kind, std::string text,
             EventNumbers numbers = {});
  /// An event; where operators are to know of it at once, it is among the announcements.
  void event(const Event& event);

  /// Events since the last call that an operator is to know of at once.
  std::vector<Event> take_announcements() { return std::exchange(announcements_, {}); }

  /// "?" for who is no entity.
  std::string_view name_of_entity(EntityId id) const;

  /// The key figure of the newest belief and the load of the air, in a few words; empty
  /// without either.
  std::string headline() const;

 private:
  void event_quietly(const Event& event);
  void sensor_changes(Time now, std::size_t i, const EntityState& state);

  const World& world_;
  Recorder& recorder_;
  std::vector<Event> announcements_;
  std::optional<double> sigma_;  // root mean square, of the newest belief [m]
  std::optional<double> air_;    // load of the fullest radio in the last radio period
  std::size_t lost_ = 0;         // messages in this radio period
  std::size_t lost_before_ = 0;  // in the last one
  Time radios_recorded_;
};

}  // namespace skein::simulation
