// SPDX-License-Identifier: Apache-2.0
#include "skein/campaign/tuning/tuning_search.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "skein/base/math.h"

namespace skein::campaign {
namespace {

const double kMaxLog = math::log(4.0);

// As a person would write it: four digits.
double rounded(double value) {
  const double digit = math::pow(10.0, std::floor(math::log10(value)) - 3);
  return std::round(value / digit) * digit;
}

}  // namespace

Result<TuningFound> search_gains(const TuningSearch& search, const ScenarioReader& reader,
                                 const RunScenario& run, const BatchOptions& options) {
  BatchOptions quiet = options;
  quiet.progress = {};
  std::optional<Error> error;
  TuningFound found;
  int tried = 0;
  double best = 0;

  const auto values_at = [&](const std::vector<double>& logs) {
    std::vector<double> values = search.start;
    for (std::size_t i = 0; i < values.size(); ++i)
      values[i] = rounded(values[i] * math::exp(std::clamp(logs[i], -kMaxLog, kMaxLog)));
    return values;
  };
  // An interruption ends the search, with what has been found; all else ends it for good.
  const auto ended = [&](const Error& why) -> std::optional<double> {
    if (why.code != ErrorCode::kInterrupted) error = why;
    return {};
  };
  const auto cost = [&](const std::vector<double>& logs) -> std::optional<double> {
    TuningStudy study = search.study;
    study.sets = {{fmt::format("search/{}", tried), search.lap_gains(values_at(logs))}};
    const auto plan = plan_comparison(study, reader);
    if (!plan) return ended(plan.error());
    const auto outcomes = run_batch(plan.value().items, run, quiet);
    if (!outcomes) return ended(outcomes.error());
    double sum = 0;
    for (const BatchOutcome& outcome : outcomes.value()) {
      if (!outcome.error.empty()) found.error = outcome.error;
      if (!outcome.summary) return {};
      sum += flight_cost(*outcome.summary);
    }
    const double mean = sum / static_cast<double>(outcomes.value().size());
    best = tried == 0 ? mean : std::min(best, mean);
    ++tried;
    if (search.progress) search.progress(tried, best);
    return mean;
  };

  SimplexOptions simplex;
  simplex.evaluations = search.evaluations;
  found.search =
      simplex_search(cost, std::vector<double>(search.start.size(), 0.0), simplex);
  if (error) return *error;
  for (SimplexTry& each : found.search.tries) each.at = values_at(each.at);
  if (!found.search.best.at.empty())
    found.search.best.at = values_at(found.search.best.at);
  return found;
}

}  // namespace skein::campaign
