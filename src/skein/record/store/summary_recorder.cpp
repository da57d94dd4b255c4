// SPDX-License-Identifier: Apache-2.0
#include "skein/record/store/summary_recorder.h"

#include <cmath>
#include <utility>

namespace skein::record {

SummaryRecorder::SummaryRecorder(RunInfo info) : info_(std::move(info)) {}

void SummaryRecorder::record(const Record& record) {
  hash_.add(record);
  statistics_.take(record);
}

Result<void> SummaryRecorder::step_done(Time time) {
  now_ = time;
  ++steps_;
  // Rows of tables, which nobody keeps here.
  statistics_.missions().take_series();
  statistics_.forecasts().take_scores();
  return {};
}

RunSummary SummaryRecorder::summary(bool interrupted) const {
  return make_summary(info_, hash_, statistics_, extra_, {now_, steps_},
                      std::chrono::steady_clock::now() - started_, interrupted);
}

RunSummary make_summary(const RunInfo& info, const ContentHash& hash,
                        const RunStatistics& statistics,
                        const std::map<std::string, double>& extra, RunReach reach,
                        std::chrono::duration<double> wall, bool interrupted) {
  RunSummary summary;
  summary.version = info.version;
  summary.name = info.name;
  summary.seed = info.seed;
  summary.content_hash = hash.hex();
  summary.interrupted = interrupted;
  summary.numbers = statistics.figures();
  summary.numbers["simulated_s"] = reach.simulated.seconds();
  summary.numbers["steps"] = static_cast<double>(reach.steps);
  summary.numbers["wall_s"] = wall.count();
  if (wall.count() > 0)
    summary.numbers["real_time_factor"] = reach.simulated.seconds() / wall.count();
  summary.numbers["deadline_misses"] = 0;
  for (const auto& [name, value] : extra) summary.numbers[name] = value;
  // A figure that is not finite does not exist.
  std::erase_if(summary.numbers,
                [](const auto& figure) { return !std::isfinite(figure.second); });
  return summary;
}

}  // namespace skein::record
