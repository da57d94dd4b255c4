// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "skein/base/output_file.h"
#include "skein/base/result.h"
#include "skein/link/relay/relay.h"

namespace skein::app {

/// What a relay has done so far, for people.
std::string relay_table(const skein::relay::RelayReport& report);

/// A table of sessions over time (CSV); docs/relay.md has its columns.
class RelayStatisticsFile {
 public:
  /// Fails: kUnavailable when the file cannot be written.
  Result<void> open(const std::filesystem::path& file);

  /// Rows of the sessions that are open, and the last ones of those that have ended.
  /// Nothing without a file. Fails: kUnavailable.
  Result<void> write(skein::relay::Relay& relay);

 private:
  OutputStream out_;
};

}  // namespace skein::app
