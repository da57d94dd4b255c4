// SPDX-License-Identifier: Apache-2.0
#include "skein/campaign/monitoring/monitoring_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string_view>

#include "skein/campaign/batch/variant_grid.h"

namespace skein::campaign {

std::vector<Variant> monitoring_cases() {
  // Wind from the south-west moves the boundary to the north-east: equal components.
  return {
      {"no-wind", "3 m/s, no wind, 3,600 s", {}},
      {"wind-0.3",
       "3 m/s, wind 0.3 m/s that the estimator is not given, 3,600 s",
       {"environment.phenomena[0].wind_mps=[0.212132, 0.212132]"}},
      {"wind-1.0",
       "3 m/s, wind 1.0 m/s that the estimator is not given, 3,600 s",
       {"environment.phenomena[0].wind_mps=[0.707107, 0.707107]"}},
      {"wind-1.0-known",
       "3 m/s, wind 1.0 m/s that the estimator is given, 1,800 s",
       {"environment.phenomena[0].wind_mps=[0.707107, 0.707107]",
        "missions[0].prior.wind_mps=[0.707107, 0.707107]",
        "missions[0].prior.wind_sd_mps=0.05", "duration_s=1800"}},
      {"slow",
       "0.2 m/s with errors up to 0.02 m/s, wind 0.1 m/s that the estimator is not "
       "given, 3,600 s",
       {"environment.phenomena[0].rate_mps=0.2",
        "environment.phenomena[0].rate_error_mps=0.02",
        "environment.phenomena[0].wind_mps=[0.0707107, 0.0707107]",
        "missions[0].prior.rate_mps=0.2", "missions[0].prior.rate_sd_mps=0.0116",
        "missions[0].prior.wind_sd_mps=0.1"}},
      {"rate-2.4",
       "the estimator is given 3 m/s, the fire spreads with 2.4 m/s, 1,800 s",
       {"environment.phenomena[0].rate_mps=2.4", "duration_s=1800"}},
      {"gnss",
       "as no-wind, with a position error of 2 m per axis that wanders within a minute",
       {"aircraft[0].sensors[0]={kind: gnss, position_sd_m: 2}"}},
      {"sectors",
       "rate random per 6-degree sector (the estimator's prior is too smooth), 1,800 s",
       {"environment.phenomena[0].rate_sectors=60",
        "environment.phenomena[0].rate_harmonics=0", "duration_s=1800"}},
  };
}

bool of_the_thesis(const std::string& estimator) {
  static constexpr std::string_view kThesis[] = {
      "qkf", "mle", "map", "ukf", "qkf-a15", "particle", "point-reset"};
  return std::find(std::begin(kThesis), std::end(kThesis), estimator) !=
         std::end(kThesis);
}

std::vector<Variant> monitoring_strategies() {
  return {
      {"gus", "the thesis's routing", {"missions[0].strategy=gus"}},
      {"gus-rate", "the same per second of flight", {"missions[0].strategy=gus-rate"}},
      {"ellipse", "to the largest major axis", {"missions[0].strategy=ellipse"}},
      {"tracking-predicted",
       "benchmark, reading (i): follows its own predicted edge",
       {"missions[0].strategy={kind: tracking, predicted: true}",
        "missions[0].forced_crossing_s=0"}},
      {"tracking-binary",
       "benchmark, reading (ii): finds the real edge with the binary sensor",
       {"missions[0].strategy=tracking"}},
      {"tracking-ideal",
       "benchmark, reading (iii): ideal edge follower",
       {"missions[0].strategy=tracking", "aircraft[0].sensors[3]=edge-finder"}},
      {"partition", "each aircraft its own arc", {"missions[0].strategy=partition"}},
      {"sweep", "arc sweeps along the real edge", {"missions[0].strategy=sweep"}},
  };
}

Result<StudyPlan> plan_monitoring_study(const MonitoringStudy& study,
                                        const ScenarioReader& reader) {
  // Libraries that the scenario names may have estimators too.
  std::vector<scenario::Override> changes;
  for (const std::string& text : study.overrides) changes.push_back({text});
  if (auto read = reader.read(study.base, changes); !read) return read.error();
  std::vector<Variant> estimators;
  for (const std::string& name : reader.kinds().names("estimator"))
    estimators.push_back({name, "", {"missions[0].estimator=" + name}});
  const auto cases = select(monitoring_cases(), study.cases, "case");
  if (!cases) return cases.error();
  const auto chosen = select(estimators, study.estimators, "estimator");
  if (!chosen) return chosen.error();
  const auto strategies = select(monitoring_strategies(), study.strategies, "strategy");
  if (!strategies) return strategies.error();
  return plan_grid({study.base, cases.value(), strategies.value(), chosen.value(),
                    study.overrides, study.first_seed, study.seeds},
                   reader);
}

namespace {

std::vector<double> values_of(const StudyCell& cell,
                              const std::vector<BatchOutcome>& outcomes,
                              const std::string& name) {
  std::vector<double> values;
  for (const std::size_t item : cell.items)
    if (outcomes[item].summary)
      if (const auto value = outcomes[item].summary->number(name))
        values.push_back(*value);
  return values;
}

}  // namespace

FigureTally tally_of(const StudyCell& cell, const std::vector<BatchOutcome>& outcomes,
                     const std::string& name) {
  FigureTally tally;
  for (const double value : values_of(cell, outcomes, name)) {
    tally.count += 1;
    tally.sum += value;
    tally.min = std::fmin(tally.min, value);
    tally.max = std::fmax(tally.max, value);
  }
  return tally;
}

MeanInterval figure_of(const StudyCell& cell, const std::vector<BatchOutcome>& outcomes,
                       const std::string& name) {
  MeanInterval figure = mean_interval(values_of(cell, outcomes, name));
  figure.requested = static_cast<int>(cell.items.size());
  return figure;
}

std::string StudyCell::path() const {
  std::string path;
  for (const std::string* part : {&case_name, &strategy, &estimator}) {
    if (part->empty()) continue;
    if (!path.empty()) path += '/';
    path += *part;
  }
  return path;
}

std::string figure_text(const MeanInterval& figure, int digits) {
  if (figure.count == 0) return {};
  std::string text = fmt::format("{:.{}f}", figure.mean, digits);
  if (figure.count > 1) text += fmt::format(" ± {:.{}f}", figure.half_width, digits);
  if (figure.count < figure.requested) text += fmt::format(" (n = {})", figure.count);
  return text;
}

bool depends_on_machine(const std::string& name) {
  return name == "wall_s" || name == "real_time_factor" || name == "cpu_s";
}

std::string partial_text(const std::vector<BatchOutcome>& outcomes) {
  std::size_t done = 0, failed = 0;
  for (const BatchOutcome& outcome : outcomes) {
    if (outcome.summary) ++done;
    if (!outcome.error.empty()) ++failed;
  }
  if (done == outcomes.size()) return {};
  std::string text = fmt::format("partial: {} of {} runs", done, outcomes.size());
  if (failed > 0) text += fmt::format(", {} failed", failed);
  return text;
}

std::vector<std::string> warnings_of(const std::vector<BatchOutcome>& outcomes) {
  std::vector<std::string> all;
  for (const BatchOutcome& outcome : outcomes)
    if (outcome.summary)
      for (const std::string& warning : outcome.summary->warnings)
        if (std::find(all.begin(), all.end(), warning) == all.end())
          all.push_back(warning);
  return all;
}

}  // namespace skein::campaign
