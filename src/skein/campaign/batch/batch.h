// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "skein/base/result.h"
#include "skein/record/store/summary.h"
#include "skein/scenario/scenario.h"

namespace skein::campaign {

/// One run of a batch. `text` is the scenario with all defaults filled in, empty where
/// the run is of something else; `data` stands for the files it names
/// (data_fingerprint.h), or for that something. Together with the program they decide
/// whether an earlier result still counts.
struct BatchItem {
  std::string name;  ///< unique in the batch
  scenario::Scenario scenario;
  std::string text;
  std::string data;
};

/// What became of one item: a summary, or why there is none.
struct BatchOutcome {
  std::optional<record::RunSummary> summary;
  std::string error;  ///< empty unless the run failed
};

/// Runs one scenario to its end without records of its own.
using RunScenario = std::function<Result<record::RunSummary>(const BatchItem& item)>;

struct BatchOptions {
  int threads = 1;
  std::string program;                      ///< changes whenever the program does
  std::filesystem::path journal;            ///< finished runs, one JSON object per line
  const std::atomic<bool>* stop = nullptr;  ///< asks for an early end; may be null
  /// Called after each run, one call at a time; may be empty.
  std::function<void(std::size_t done, std::size_t all)> progress;
};

/// Runs all items, several at a time. Every finished run is appended to the journal at
/// once, so that a batch that was interrupted or killed goes on where it was; results of
/// the same scenario, data and program are taken from there.
///
/// @returns one outcome per item, in the order of the items; items that were not reached
///          because of `stop` have neither summary nor error.
/// Fails:   kUnavailable when the journal cannot be read or written, at once;
///          kBadInput when it is no regular file.
Result<std::vector<BatchOutcome>> run_batch(std::span<const BatchItem> items,
                                            const RunScenario& run,
                                            const BatchOptions& options);

/// Mean of `values` with the half width of its 95 % confidence interval (Student's t).
struct MeanInterval {
  double mean = 0;
  double half_width = 0;  ///< 0 for fewer than two values
  int count = 0;
  int requested = 0;  ///< how many there would be, had all runs ended well; 0 = not known
};
MeanInterval mean_interval(std::span<const double> values);

}  // namespace skein::campaign
