// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "skein/base/result.h"

namespace skein::process {

/// A program to be started.
struct Program {
  /// The program and its arguments. A name without a slash is looked for in PATH; a
  /// relative path begins in this program's folder, not in `folder`.
  std::vector<std::string> arguments;
  std::filesystem::path folder;          ///< that it works in; empty: this program's
  std::filesystem::path log;             ///< gets its output and errors; begins empty
  std::vector<std::string> environment;  ///< NAME=value, on top of this program's
};

struct ProcessStatus {
  bool running = true;
  int exit_code = 0;  ///< of what has ended by itself
  int signal = 0;     ///< that has ended it; 0: none

  /// For people: "running", "ended with 1", "killed by signal TERM".
  std::string text() const;
};

/// A program that this one has started, with all that it starts itself and leaves in its
/// process group.
///
/// It reads nothing (/dev/null) and has no open file of this program. It is killed when
/// the thread that started it ends, however that comes about; what it has started itself
/// then lives on, so a script should end in `exec`.
///
/// Threads: one at a time may call. No call waits for the program.
class ChildProcess {
 public:
  using Clock = std::chrono::steady_clock;

  /// Fails: kNotFound for a program or folder that is not there, kBadInput for a file
  ///        that cannot be run, kUnavailable for a log that cannot be written or when
  ///        there can be no more processes.
  static Result<ChildProcess> start(const Program& program);

  ChildProcess(ChildProcess&& other) noexcept;
  ChildProcess& operator=(ChildProcess&& other) noexcept;
  /// Kills it and all its group. Who wants an orderly end calls stop() first, and look()
  /// until it has ended.
  ~ChildProcess();

  /// How it is. Kills it when stop() was two seconds ago, and what is left of its group
  /// when it has ended.
  const ProcessStatus& look(Clock::time_point now);

  /// Asks it and its group to end (SIGTERM); the first call counts.
  void stop(Clock::time_point now);

  /// Of its log: at most so many, and no more than 16 KiB; none of a pipe or a device.
  /// Fit for a terminal.
  std::vector<std::string> last_lines(std::size_t count) const;

  pid_t id() const { return process_; }

 private:
  ChildProcess(pid_t process, std::filesystem::path log)
      : process_(process), log_(std::move(log)) {}
  void kill_group(int signal) const;
  bool reap();

  pid_t process_ = -1;
  std::filesystem::path log_;
  ProcessStatus status_;
  std::optional<Clock::time_point> stop_due_;  // when it is killed
};

}  // namespace skein::process
