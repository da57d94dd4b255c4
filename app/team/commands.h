// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/common/command_options.h"
#include "skein/exchange/team/team_answers.h"

namespace skein::app {

// Each adds a sub-command to `skein team`.

/// @param stop  asks for an early end.
Command add_team_allocate(CLI::App& team, const std::atomic<bool>& stop);
Command add_team_route(CLI::App& team, const std::atomic<bool>& stop);
Command add_team_tours(CLI::App& team, const std::atomic<bool>& stop);
Command add_team_rehearse(CLI::App& team, const std::atomic<bool>& stop);
Command add_team_messages(CLI::App& team, const std::atomic<bool>& stop);

/// Options of commands that answer a file of problems.
struct TeamBatchArguments {
  std::filesystem::path batch;
  std::filesystem::path out;
  double seconds = 0;  ///< for each problem; 0: time does not count
  std::uint64_t seed = 1;
  int threads = 1;              ///< problems at a time
  std::int64_t iterations = 0;  ///< 0: what the problem suggests
  bool prove = false;
};
void add_batch_options(CLI::App& command, TeamBatchArguments& given);

/// Answers the problems, several at a time, and writes a table of answers.
///
/// @param count  of the problems.
/// @param solve  answers one of them.
/// @returns      the exit status; what fails is said.
int answer_batch(
    const TeamBatchArguments& given, std::size_t count,
    const std::function<Result<exchange::TeamAnswer>(std::size_t, const solve::Effort&)>&
        solve,
    const std::atomic<bool>& stop);

}  // namespace skein::app
