// SPDX-License-Identifier: Apache-2.0
#include "skein/campaign/tuning/tuning_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "skein/base/math.h"
#include "skein/campaign/batch/data_fingerprint.h"
#include "skein/campaign/batch/lap_recorder.h"
#include "skein/scenario/named_files.h"
#include "skein/scenario/scenario_file.h"

namespace skein::campaign {
namespace {

constexpr double kLapTime = 200;  // of the shipped scenario, in strong wind as well [s]
constexpr double kUnfinished = 1000;  // cost of a lap that was not completed
constexpr double kEffortScale = 20;   // [deg/s]

Result<BatchItem> flight_of(const TuningStudy& study, const std::string& name, int seed,
                            const std::vector<std::string>& changes,
                            const ScenarioReader& reader, DataFingerprint& data) {
  std::vector<scenario::Override> overrides;
  for (const std::string& text : changes) overrides.push_back({text});
  auto read = reader.read(study.base, overrides);
  if (!read) return read.error();
  BatchItem item;
  item.scenario = std::move(read).value();
  item.scenario.seed = static_cast<std::uint64_t>(seed);
  item.scenario.name = item.name = fmt::format("{}/{}", name, seed);
  item.text = scenario::write_scenario(item.scenario, reader.kinds());
  auto files = data.of(scenario::named_files(item.scenario, reader.kinds()));
  if (!files) return files.error();
  item.data = std::move(files).value();
  return item;
}

}  // namespace

Result<TuningPlan> plan_laps(const TuningStudy& study, const ScenarioReader& reader) {
  TuningPlan plan;
  DataFingerprint data;
  const std::size_t laps = study.sets.size();
  for (int k = 0; k < study.seeds; ++k) {
    TuningFlight flight;
    std::vector<std::string> changes;
    if (laps != kGainsLaps)
      changes.push_back(
          fmt::format("duration_s={}", kLapTime * static_cast<double>(laps)));
    changes.insert(changes.end(), study.overrides.begin(), study.overrides.end());
    changes.push_back(fmt::format("aircraft[0].agent.laps={}", laps));
    std::string gains;
    for (std::size_t lap = 0; lap < laps; ++lap) {
      flight.sets.push_back((lap + static_cast<std::size_t>(k)) % laps);
      gains += (lap > 0 ? ", " : "") + study.sets[flight.sets.back()].lap_gains;
    }
    changes.push_back("aircraft[0].autopilot.lap_gains=[" + gains + "]");
    auto item = flight_of(study, "laps", study.first_seed + k, changes, reader, data);
    if (!item) return item.error();
    flight.item = plan.items.size();
    plan.items.push_back(std::move(item).value());
    plan.flights.push_back(std::move(flight));
  }
  return plan;
}

Result<TuningPlan> plan_comparison(const TuningStudy& study,
                                   const ScenarioReader& reader) {
  TuningPlan plan;
  DataFingerprint data;
  for (std::size_t set = 0; set < study.sets.size(); ++set) {
    std::vector<std::string> changes = study.overrides;
    changes.push_back(fmt::format("aircraft[0].agent.laps={}", kGainsLaps));
    changes.push_back("aircraft[0].autopilot.lap_gains=[" + study.sets[set].lap_gains +
                      "]");
    for (int k = 0; k < study.seeds; ++k) {
      auto item = flight_of(study, study.sets[set].name, study.first_seed + k, changes,
                            reader, data);
      if (!item) return item.error();
      plan.flights.push_back(
          {plan.items.size(), std::vector<std::size_t>(kGainsLaps, set)});
      plan.items.push_back(std::move(item).value());
    }
  }
  return plan;
}

bool TuningFlight::changes() const {
  return std::adjacent_find(sets.begin(), sets.end(), std::not_equal_to<>()) !=
         sets.end();
}

std::optional<double> lap_figure(const record::RunSummary& flight, int lap,
                                 const std::string& figure) {
  return flight.number(fmt::format("lap{}_{}", lap + 1, figure));
}

double lap_cost(const record::RunSummary& flight, int lap) {
  if (flight.number("laps").value_or(0) <= lap) return kUnfinished;
  const auto squared = [&](const char* figure, double scale) {
    const auto value = lap_figure(flight, lap, figure);
    return value ? math::squared(*value / scale) : kUnfinished;
  };
  const double cost = squared("cross_track_rms_m", 1) + squared("height_rms_m", 1) +
                      squared("airspeed_rms_mps", 1) +
                      squared("effort_deg_per_s", kEffortScale);
  return std::min(cost, kUnfinished);
}

double flight_cost(const record::RunSummary& flight) {
  double sum = 0;
  for (int lap = 0; lap < kGainsLaps; ++lap) sum += lap_cost(flight, lap);
  return sum / kGainsLaps;
}

std::vector<double> values_of(const TuningPlan& plan,
                              const std::vector<BatchOutcome>& outcomes, std::size_t set,
                              const std::string& figure) {
  std::vector<double> values;
  for (const TuningFlight& flight : plan.flights) {
    const auto& summary = outcomes[flight.item].summary;
    if (!summary) continue;
    double sum = 0;
    int count = 0;
    for (std::size_t k = 0; k < flight.sets.size(); ++k) {
      const int lap = static_cast<int>(k);
      const auto value =
          figure == "cost" ? lap_cost(*summary, lap) : lap_figure(*summary, lap, figure);
      if (flight.sets[k] != set || !value) continue;
      sum += *value;
      ++count;
    }
    if (count > 0) values.push_back(sum / count);
  }
  return values;
}

LapCount laps_of(const TuningPlan& plan, const std::vector<BatchOutcome>& outcomes,
                 std::size_t set) {
  LapCount laps;
  for (const TuningFlight& flight : plan.flights)
    for (std::size_t k = 0; k < flight.sets.size(); ++k) {
      if (flight.sets[k] != set) continue;
      ++laps.planned;
      const auto& summary = outcomes[flight.item].summary;
      if (summary && lap_cost(*summary, static_cast<int>(k)) < kUnfinished)
        ++laps.completed;
    }
  return laps;
}

MeanInterval cost_change(const TuningPlan& plan,
                         const std::vector<BatchOutcome>& outcomes) {
  std::map<std::uint64_t, double> before;  // by seed
  std::vector<double> changes;
  for (const std::size_t set : {0u, 1u})
    for (const TuningFlight& flight : plan.flights) {
      const auto& summary = outcomes[flight.item].summary;
      if (!summary || flight.changes() || flight.sets.front() != set) continue;
      const std::uint64_t seed = plan.items[flight.item].scenario.seed;
      if (set == 0)
        before[seed] = flight_cost(*summary);
      else if (const auto found = before.find(seed); found != before.end())
        changes.push_back(flight_cost(*summary) - found->second);
    }
  return mean_interval(changes);
}

std::string tuning_csv(const TuningStudy& study, const TuningPlan& plan,
                       const std::vector<BatchOutcome>& outcomes) {
  std::string csv = "seed,lap,gains,content_hash,cost";
  for (const LapFigure& figure : kLapFigures) csv += fmt::format(",{}", figure.name);
  csv += "\n";
  for (const TuningFlight& flight : plan.flights) {
    const auto& summary = outcomes[flight.item].summary;
    if (!summary) continue;
    for (std::size_t lap = 0; lap < flight.sets.size(); ++lap) {
      csv += fmt::format("{},{},{},{}", plan.items[flight.item].scenario.seed, lap + 1,
                         study.sets[flight.sets[lap]].name, summary->content_hash);
      const double cost = lap_cost(*summary, static_cast<int>(lap));
      csv += std::isfinite(cost) ? fmt::format(",{:.9g}", cost) : ",";
      for (const LapFigure& figure : kLapFigures) {
        const auto value = lap_figure(*summary, static_cast<int>(lap), figure.name);
        csv += value ? fmt::format(",{:.9g}", *value) : ",";
      }
      csv += "\n";
    }
  }
  return csv;
}

StudyFigures tuning_figures(const TuningStudy& study, const TuningPlan& plan,
                            const std::vector<BatchOutcome>& outcomes) {
  StudyFigures figures{{"runs", 0}, {"runs_failed", 0}, {"runs_missing", 0}};
  for (const BatchOutcome& outcome : outcomes)
    ++figures[outcome.summary         ? "runs"
              : outcome.error.empty() ? "runs_missing"
                                      : "runs_failed"];
  for (std::size_t set = 0; set < study.sets.size(); ++set) {
    const std::string prefix = study.sets[set].name + "/";
    const auto put = [&](const std::string& name) {
      const MeanInterval mean = mean_interval(values_of(plan, outcomes, set, name));
      if (mean.count > 0) figures[prefix + name] = mean.mean;
      if (mean.count > 1) figures[prefix + name + "_ci95"] = mean.half_width;
    };
    figures[prefix + "laps"] = laps_of(plan, outcomes, set).completed;
    for (const LapFigure& figure : kLapFigures) put(figure.name);
    put("cost");
  }
  return figures;
}

}  // namespace skein::campaign
