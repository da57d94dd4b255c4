// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <optional>
#include <vector>

#include "skein/data/vehicle/vehicle_report.h"
#include "skein/link/process/kept_program.h"

namespace skein::physics {

/// The program of an outside autopilot, if it is ours to start, and what is said of it.
class DrivingProgram {
 public:
  DrivingProgram() = default;
  explicit DrivingProgram(process::KeptProgram program) : program_(std::move(program)) {}

  Result<void> start() { return program_ ? program_->start() : Result<void>(); }

  /// Appends what has become of it.
  /// @returns  whether another has been started.
  bool look(std::vector<OutsideEvent>& events) {
    if (!program_) return false;
    const auto change = program_->look(std::chrono::steady_clock::now());
    if (!change) return false;
    events.push_back(
        {change->started ? EventKind::kAutopilotRestarted : EventKind::kAutopilotEnded,
         change->text});
    return change->started;
  }

  /// It is known to have ended, and so will not answer.
  bool ended() { return program_ && !program_->runs(std::chrono::steady_clock::now()); }
  bool is_ours() const { return program_.has_value(); }
  void stop() {
    if (program_) program_->stop(std::chrono::steady_clock::now());
  }

 private:
  std::optional<process::KeptProgram> program_;
};

}  // namespace skein::physics
