// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <vector>

#include "skein/assemble/kinds/kind_registry.h"
#include "skein/assemble/world/build.h"
#include "skein/base/result.h"
#include "skein/record/store/summary.h"
#include "skein/role/operator_console.h"
#include "skein/role/recorder.h"
#include "skein/scenario/scenario.h"
#include "skein/simulation/run.h"

namespace skein::assemble {

/// Asks whether the programs of a scenario may be started, if it has any; open_links()
/// does so too. Fails: kUnavailable, with what to do, when they may not.
Result<void> check_consent(const Build& ready);

/// Opens the links to whoever takes part from outside, and starts their programs; before
/// run_linked(), by the same thread.
/// @returns  where servers wait.
/// Fails: as check_consent(); what cannot be opened or started.
Result<std::vector<std::string>> open_links(Build& ready);

/// Runs a world with ground stations, or the world that an agent takes part in, as
/// listeners and givers of commands, if it has any.
/// @param recorder  null: nothing is recorded; then there are such listeners.
/// Fails: as simulation::run().
Result<simulation::RunOutcome> run_linked(Build& ready, Recorder* recorder,
                                          OperatorConsole& console);

/// How a run without records of its own is done.
struct QuietRun {
  std::string version;  ///< of the program, for the summary
  std::string text;     ///< the scenario with all defaults, for the summary; may be empty
  double speed = 0;     ///< simulated seconds per wall second; 0 = as fast as possible
  int threads = 1;
  const std::atomic<bool>* stop = nullptr;  ///< asks for an early end; may be null
  Recorder* listener = nullptr;        ///< receives all that is recorded; may be null
  OperatorConsole* console = nullptr;  ///< gives commands; may be null
  /// Called with the world before it runs; may be empty.
  std::function<void(simulation::World&)> prepare = {};
};

/// Builds a scenario, runs it and gives its key figures; writes nothing. One that goes by
/// the wall clock is run in real time, whatever its speed is to be.
/// Fails: as build(), open_links() and simulation::run(); kInterrupted when stopped
///        early.
Result<record::RunSummary> run_quietly(const scenario::Scenario& scenario,
                                       const KindRegistry& kinds, const QuietRun& how);

}  // namespace skein::assemble
