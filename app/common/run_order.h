// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <optional>

#include "app/common/commands.h"
#include "skein/assemble/kinds/kind_registry.h"
#include "skein/assemble/world/build.h"
#include "skein/base/result.h"
#include "skein/record/store/replay.h"
#include "skein/scenario/scenario.h"

namespace skein::app {

/// What shall be run.
struct RunOrder {
  assemble::KindRegistry kinds;
  scenario::Scenario scenario;
  std::optional<record::RecordedRun> recorded;     ///< that is done again
  std::optional<assemble::AgentOrder> agent = {};  ///< of a single agent; none: all
};

/// Runs it, with records, summary and report as the arguments say; the exit status.
int run_order(const RunOrder& order, const RunArguments& arguments,
              const std::atomic<bool>& stop);

/// Runs it in real time, without records; the exit status.
int run_unrecorded(const RunOrder& order, const std::atomic<bool>& stop);

}  // namespace skein::app
