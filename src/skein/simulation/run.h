// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "skein/base/result.h"
#include "skein/base/time.h"
#include "skein/data/command/command.h"
#include "skein/role/operator_console.h"
#include "skein/role/recorder.h"
#include "skein/simulation/world.h"

namespace skein::simulation {

/// How a run moves. Periods are multiples of `step`.
struct RunOptions {
  Time step = Time::from_seconds(0.1);
  Time duration = Time::from_seconds(3600);
  Time environment_period = Time::from_seconds(1);  ///< of moving phenomena
  Time record_period = Time::from_seconds(0.1);     ///< of recording truth and estimates
  Time perimeter_period = Time::from_seconds(5);    ///< of comparing belief and truth
  Time radio_period = Time::from_seconds(10);       ///< of statistics of radios
  /// Simulated seconds per second of wall time; 0 = as fast as possible.
  double speed = 0;
  int threads = 1;
  /// Given at their times, before what the console says; in order of time.
  std::vector<CommandRecord> commands;
  /// Pauses and speeds that are commanded hold; else they are only recorded (a replay).
  bool clock_by_command = true;
  /// Whoever takes part from outside flies by the wall clock: commands of another speed
  /// are refused.
  bool real_time_only = false;
};

/// How a run ended.
struct RunOutcome {
  enum class End { kDone, kStopped };
  End end = End::kDone;
  Time simulated;
  double wall_s = 0;
  /// Steps that began later than real time asked for (by more than one step).
  std::int64_t deadline_misses = 0;
};

/// Moves `world` through time until the end or until the operator asks to stop.
///
/// Before each step commands are obeyed: those of the options, then what the console has
/// taken in since the last. While it is paused the run waits and asks the console.
/// Each step: environment -> sensors -> agents -> radio -> autopilots -> plants ->
/// record. Entities run in parallel inside a phase, each writing only itself; messages
/// are merged in entity order. So the records depend on neither `threads` nor `speed`.
///
/// Fails: kUnavailable when the recorder can no longer write or memory runs out;
/// kInternal when a step finds a bug in Skein. The message says the simulated time. An
/// aircraft that hits the ground, or whose motion stops being finite, ends with an event
/// "accident"; the run goes on.
Result<RunOutcome> run(World& world, const RunOptions& options, Recorder& recorder,
                       OperatorConsole& console);

}  // namespace skein::simulation
