// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <string>

#include "skein/record/figures/statistics.h"
#include "skein/record/store/content_hash.h"
#include "skein/role/recorder.h"

namespace skein::record {

/// A recorder without a database: content hash and key figures only. For campaigns of
/// thousands of runs; the figures equal those of a RunRecorder given the same calls.
class SummaryRecorder final : public Recorder {
 public:
  explicit SummaryRecorder(RunInfo info);

  void record(const Record& record) override;
  Result<void> step_done(Time time) override;

  /// Sets one more number of the summary, such as `deadline_misses`.
  void set_figure(const std::string& name, double value) { extra_[name] = value; }

  /// Of all so far.
  std::string content_hash() const { return hash_.hex(); }

  /// The key figures of all so far.
  RunSummary summary(bool interrupted = false) const;

 private:
  RunInfo info_;
  ContentHash hash_;
  RunStatistics statistics_;
  std::map<std::string, double> extra_;
  Time now_;
  std::uint64_t steps_ = 0;
  std::chrono::steady_clock::time_point started_ = std::chrono::steady_clock::now();
};

/// How far a run has come.
struct RunReach {
  Time simulated;           ///< time of its last step
  std::uint64_t steps = 0;  ///< 0: it has none
};

/// Puts a summary together, of what is finite. `wall` is the time that the run took on
/// the clock on the wall.
RunSummary make_summary(const RunInfo& info, const ContentHash& hash,
                        const RunStatistics& statistics,
                        const std::map<std::string, double>& extra, RunReach reach,
                        std::chrono::duration<double> wall, bool interrupted);

}  // namespace skein::record
