// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "skein/base/result.h"
#include "skein/base/time.h"
#include "skein/role/operator_console.h"
#include "skein/role/recorder.h"
#include "skein/simulation/run.h"

namespace skein::simulation {

/// How a run ended.
struct RunOutcome {
  enum class End { kDone, kStopped };
  End end = End::kDone;
  Time simulated;
  double wall_s = 0;
  /// Steps that began later than real time asked for (by more than one step).
  std::int64_t deadline_misses = 0;
};

/// Steps a run at the pace of its options, from where it is to its end or until the
/// operator asks to stop.
///
/// Before each step commands are obeyed: those of the options, then what the console has
/// taken in since the last. While it is paused the run waits and asks the console.
///
/// Fails: as Run::step().
Result<RunOutcome> run_paced(Run& run, OperatorConsole& console);

/// The same of a run that nobody else holds.
Result<RunOutcome> run_paced(World& world, const RunOptions& options, Recorder& recorder,
                             OperatorConsole& console);

}  // namespace skein::simulation
