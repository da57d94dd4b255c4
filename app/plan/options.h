// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <memory>

namespace CLI {  // NOLINT(readability-identifier-naming)
class App;
}

namespace skein::app {

/// `skein plan` and its sub-commands: their options, and which one was asked for.
class PlanOptions {
 public:
  /// Adds them to the program.
  explicit PlanOptions(CLI::App& program);
  ~PlanOptions();
  PlanOptions(const PlanOptions&) = delete;
  PlanOptions& operator=(const PlanOptions&) = delete;

  /// Whether the command line names one; asked after it was read.
  bool chosen() const;
  /// Runs it; returns the exit status.
  int run(const std::atomic<bool>& stop) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace skein::app
