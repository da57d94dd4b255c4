// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "skein/base/id.h"
#include "skein/base/result.h"
#include "skein/base/time.h"
#include "skein/data/command/command.h"
#include "skein/data/event/event.h"
#include "skein/data/event/record.h"
#include "skein/data/vehicle/autopilot.h"
#include "skein/data/vehicle/sensing.h"
#include "skein/data/vehicle/vehicle.h"
#include "skein/role/recorder.h"
#include "skein/simulation/run_options.h"
#include "skein/simulation/world.h"

namespace skein::simulation {

class RunView;
class Stepper;

/// A run that whoever made it holds: it moves when it is stepped, obeys commands in
/// between, and can be asked. Every run is one of these; run_paced() moves it by a clock.
///
/// A step begins at a multiple of RunOptions::step, from 0 to the duration, both
/// included: environment -> sensors -> agents -> radio -> autopilots -> plants -> record.
/// Entities run in parallel inside a phase, each writing only itself; messages are merged
/// in entity order. So the records depend neither on `threads` nor on who steps, and how
/// many steps at once. It looks at no clock on the wall, starts no thread that outlives
/// step(), and may be dropped at any time; several may be held in one process.
///
/// An aircraft that hits the ground, or whose motion stops being finite, ends with an
/// event "accident"; the run goes on.
///
/// Threads: one at a time.
class Run {
 public:
  /// Records what exists. Nothing has moved yet.
  /// @param world, recorder  outlive it.
  Run(World& world, RunOptions options, Recorder& recorder);
  ~Run();
  Run(const Run&) = delete;
  Run& operator=(const Run&) = delete;

  /// Makes steps; fewer when the run is over before. After the last, what is left to
  /// record is recorded.
  /// @param ticks  how many, not negative.
  /// Fails: kBadInput when the run was over before, or `ticks` is negative; kUnavailable
  ///        when the recorder can no longer write or memory runs out; kInternal when a
  ///        step finds a bug in Skein. The last two end the run: the message says the
  ///        simulated time, and comes again at every further call.
  Result<void> step(std::int64_t ticks = 1);

  /// Makes all steps that begin before `time`. Fails: as step(); a time that is past.
  Result<void> run_until(Time time);

  /// Makes all steps that are left, if any. Fails: as step().
  Result<void> run_to_end();

  /// Gives a command, which counts from the next step on, and records it. Those of the
  /// options that count from there come before it. Pauses and speeds are recorded: they
  /// are of whoever has a clock.
  /// @param sender  who gives it: "scenario", "terminal", a name.
  /// Fails: kBadInput when it cannot be obeyed, which is an event "command-refused" too:
  ///        no such aircraft, station or part. What a ground station makes of it later is
  ///        in its events. Also as step().
  Result<void> command(std::string sender, const Command& command);

  /// Obeys those commands of the options that count from the next step on; step() does so
  /// by itself. For whoever obeys pauses and speeds.
  /// @returns  them; valid as long as the run.
  /// Fails:    as step().
  Result<std::span<const CommandRecord>> obey_due();

  /// Ends the run before its end: records what is left. Nothing when it is over.
  /// Fails: as step().
  Result<void> finish();

  /// When the next step begins. The truth is that of this time.
  Time now() const { return now_; }
  /// How far it has come, at most to its end.
  Time simulated() const;
  /// No step is left: it has come to its end, was finished, or failed.
  bool over() const { return over_; }
  /// It has come to its end.
  bool completed() const { return over_ && !failure_ && now_ > options_.duration; }

  const World& world() const { return world_; }
  const RunOptions& options() const { return options_; }

  /// The aircraft or station of a name. Fails: kBadInput, with all names.
  Result<EntityId> find(std::string_view name) const;
  /// "?" for who is no entity.
  std::string_view name_of_entity(EntityId id) const;

  /// The true state of an aircraft at now(); none for what is no aircraft, or where
  /// nobody knows it.
  std::optional<VehicleState> truth(EntityId aircraft) const;
  /// What its autopilot believes and does; none before it takes part, and for what is no
  /// aircraft.
  std::optional<NavEstimate> estimate(EntityId aircraft) const;
  std::optional<AutopilotStatus> status(EntityId aircraft) const;

  // Empty without RunOptions::keeps_view; see RunView.
  /// Events since the last call.
  std::vector<Event> take_events();
  /// What a station last believed of boundaries, with the truth of then.
  std::vector<PerimeterRecord> perimeter_beliefs(EntityId station) const;
  /// What a station last believed of objects.
  std::vector<ObjectBeliefRecord> object_beliefs(EntityId station) const;
  /// What an aircraft last believed of other aircraft.
  std::vector<TrafficBeliefRecord> traffic_beliefs(EntityId aircraft) const;

  /// Events of the last call of step() or run_until() that an operator is to know of at
  /// once.
  std::span<const Event> announcements() const { return announcements_; }
  /// The key figure of the newest belief, in a few words; empty without one.
  std::string headline() const;

 private:
  template <class Action>
  Result<void> guarded(Action action);
  Result<void> check_going() const;
  void take_due();
  Result<void> tick();

  World& world_;
  const RunOptions options_;
  std::unique_ptr<RunView> view_;  // null: nothing is kept
  std::unique_ptr<Stepper> stepper_;
  Time now_;
  std::size_t next_command_ = 0;  // of the options
  std::vector<Event> announcements_;
  std::optional<Error> failure_;
  bool over_ = false;
};

}  // namespace skein::simulation
