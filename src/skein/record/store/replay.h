// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "skein/base/result.h"
#include "skein/data/command/command.h"
#include "skein/data/event/record.h"

namespace skein::record {

/// What a run needs to be done again, besides its scenario.
struct RecordedRun {
  std::string version;  ///< of the program that recorded it, as kVersion; empty: unknown
  std::vector<CommandRecord> commands;       ///< as they were given, in order
  std::vector<VehicleReportRecord> reports;  ///< of vehicles behind links, in order
  std::optional<std::string> content_hash;   ///< none: the run was cut off
  std::optional<Time> interrupted;           ///< its last step; below 0: it had none
};

/// Reads the run in `directory`.
/// Fails: as read_run(); kBadInput for commands that make no sense.
Result<RecordedRun> read_recorded(const std::filesystem::path& directory);

}  // namespace skein::record
