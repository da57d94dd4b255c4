// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "skein/base/result.h"
#include "skein/scenario/source.h"

namespace skein::assemble {

/// Says whether code that a scenario names may run in this process or be started by it.
/// Implementations are asked by several threads.
class CodeConsent {
 public:
  virtual ~CodeConsent() = default;

  /// @param file      a shared library, without symbolic links.
  /// @param named_in  the scenario that names it.
  /// Fails: with what to do, when it may not be loaded.
  virtual Result<void> library(const std::string& file,
                               const scenario::Source& named_in) = 0;

  /// @param commands  programs and arguments, all that the scenario starts; at least one.
  /// Fails: with what to do, when they may not be started.
  virtual Result<void> programs(const std::vector<std::vector<std::string>>& commands,
                                const scenario::Source& named_in) = 0;
};

/// For programs that write their scenarios themselves: everything may run.
class FullConsent final : public CodeConsent {
 public:
  Result<void> library(const std::string&, const scenario::Source&) override {
    return {};
  }
  Result<void> programs(const std::vector<std::vector<std::string>>&,
                        const scenario::Source&) override {
    return {};
  }
};

}  // namespace skein::assemble
