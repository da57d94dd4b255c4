// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <utility>

#include "skein/base/result.h"
#include "skein/link/process/process.h"

namespace skein::process {

/// A program that is started, looked after and, if so wanted, started again a second
/// after it has ended, at most ten times.
///
/// Threads: see ChildProcess; start() and look() by one thread, which outlives this.
class KeptProgram {
 public:
  using Clock = ChildProcess::Clock;

  KeptProgram(Program program, bool restart)
      : program_(std::move(program)), restart_(restart) {}

  /// Makes the folders of its log and where it works, and starts it.
  /// Fails: as ChildProcess::start(); kUnavailable for a folder that cannot be made.
  Result<void> start();

  /// What has become of it since the last call.
  struct Change {
    bool started = false;  ///< again; else it has ended
    std::string text;      ///< for people: how it ended, with the last lines of its log
  };
  std::optional<Change> look(Clock::time_point now);

  /// It runs, as far as is known without waiting; any thread may call it between calls of
  /// the others.
  bool runs(Clock::time_point now);

  /// Asks it to end.
  void stop(Clock::time_point now);

  const Program& program() const { return program_; }

 private:
  Program program_;
  bool restart_;
  std::optional<ChildProcess> process_;
  bool ended_ = true;  // and reported
  int restarts_ = 0;
  Clock::time_point again_at_;
};

}  // namespace skein::process
