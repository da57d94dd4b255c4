// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "skein/base/result.h"
#include "skein/base/time.h"

namespace skein::record {

/// What a run was. Kept in the database's `meta` table.
struct RunInfo {
  std::string version;  ///< of Skein
  std::uint64_t seed = 0;
  std::string name;           ///< of the scenario, for people; may be empty
  std::string scenario_text;  ///< the scenario as run, all defaults filled in
  std::string start_utc;      ///< ISO 8601; simulated time 0; may be empty
};

/// The key figures of a run. Names are those of `summary.json`: see docs/records.md.
struct RunSummary {
  std::string version;
  std::string name;
  std::uint64_t seed = 0;
  std::string content_hash;
  bool interrupted = false;
  std::map<std::string, double> numbers;  ///< finite ones only
  std::vector<std::string> warnings;      ///< what was repaired in outside data

  /// The number called `name`; absent when the run has no such figure, or one that is
  /// not finite.
  std::optional<double> number(const std::string& name) const;
};

/// Writes the summary as one flat JSON object; the file appears whole or not at all.
/// Fails: kUnavailable when the file cannot be written.
Result<void> write_summary(const RunSummary& summary, const std::filesystem::path& file);

/// Writes named texts, then named numbers (those that are finite), in the same form.
/// Fails: kUnavailable when the file cannot be written.
Result<void> write_flat_json(
    const std::vector<std::pair<std::string, std::string>>& texts,
    const std::map<std::string, double>& numbers, const std::filesystem::path& file);

}  // namespace skein::record
