#pragma once

#include <atomic>
#include <string>

#include "skein/assemble/kind_registry.h"
#include "skein/base/result.h"
#include "skein/record/summary.h"
#include "skein/role/recorder.h"
#include "skein/scenario/scenario.h"

namespace skein::assemble {

/// How a run without records of its own is done.
struct QuietRun {
  std::string version;  ///< of the program, for the summary
  std::string text;     ///< the scenario with all defaults, for the summary; may be empty
  double speed = 0;     ///< simulated seconds per wall second; 0 = as fast as possible
  int threads = 1;
  const std::atomic<bool>* stop = nullptr;  ///< asks for an early end; may be null
  Recorder* listener = nullptr;  ///< receives all that is recorded; may be null
};

/// Builds a scenario, runs it and gives its key figures; writes nothing.
/// Fails: as build() and simulation::run(); kInterrupted when stopped early.
Result<record::RunSummary> run_quietly(const scenario::Scenario& scenario,
                                       const KindRegistry& kinds, const QuietRun& how);

}  // namespace skein::assemble
