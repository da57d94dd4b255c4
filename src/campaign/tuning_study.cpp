#include "campaign/tuning_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "campaign/data_fingerprint.h"
#include "campaign/lap_recorder.h"
#include "scenario/named_files.h"
#include "scenario/scenario_file.h"

namespace skein::campaign {
namespace {

constexpr double kLapTime = 140;      // of the shipped scenario, with reserve [s]
constexpr double kUnfinished = 1000;  // cost of a lap that was not completed
constexpr double kEffortScale = 20;   // [deg/s]

Result<BatchItem> flight_of(const TuningStudy& study, const std::string& name, int seed,
                            const std::vector<std::string>& changes,
                            const scenario::KindTable& kinds, DataFingerprint& data) {
  std::vector<scenario::Override> overrides;
  for (const std::string& text : changes) overrides.push_back({text});
  auto read = scenario::read_scenario(study.base, kinds, overrides);
  if (!read.ok()) return Error{ErrorCode::kBadInput, "", read.report(), ""};
  BatchItem item;
  item.scenario = std::move(*read.scenario);
  item.scenario.seed = static_cast<std::uint64_t>(seed);
  item.scenario.name = item.name = fmt::format("{}/{}", name, seed);
  item.text = scenario::write_scenario(item.scenario, kinds);
  item.data = data.of(scenario::named_files(item.scenario, kinds));
  return item;
}

}  // namespace

Result<TuningPlan> plan_tuning_study(const TuningStudy& study,
                                     const scenario::KindTable& kinds) {
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
    auto item = flight_of(study, "laps", study.first_seed + k, changes, kinds, data);
    if (!item) return item.error();
    flight.item = plan.items.size();
    plan.items.push_back(std::move(item).value());
    plan.flights.push_back(std::move(flight));
  }
  return plan;
}

Result<TuningPlan> plan_gains_flights(const TuningStudy& study, const GainSet& gains,
                                      const scenario::KindTable& kinds) {
  TuningPlan plan;
  DataFingerprint data;
  std::vector<std::string> changes = study.overrides;
  changes.push_back(fmt::format("aircraft[0].agent.laps={}", kGainsLaps));
  changes.push_back("aircraft[0].autopilot.lap_gains=[" + gains.lap_gains + "]");
  for (int k = 0; k < study.seeds; ++k) {
    auto item = flight_of(study, gains.name, study.first_seed + k, changes, kinds, data);
    if (!item) return item.error();
    plan.flights.push_back({plan.items.size(), {}});
    plan.items.push_back(std::move(item).value());
  }
  return plan;
}

double lap_cost(const record::RunSummary& flight, int lap) {
  if (flight.number("laps").value_or(0) <= lap) return kUnfinished;
  const auto squared = [&](const char* figure, double scale) {
    const auto value = flight.number(fmt::format("lap{}_{}", lap + 1, figure));
    return value ? std::pow(*value / scale, 2) : kUnfinished;
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
    for (std::size_t lap = 0; lap < flight.sets.size(); ++lap) {
      if (flight.sets[lap] != set) continue;
      if (figure == "cost")
        values.push_back(lap_cost(*summary, static_cast<int>(lap)));
      else if (const auto value =
                   summary->number(fmt::format("lap{}_{}", lap + 1, figure)))
        values.push_back(*value);
    }
  }
  return values;
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
      csv +=
          fmt::format("{},{},{},{},{:.9g}", plan.items[flight.item].scenario.seed,
                      lap + 1, study.sets[flight.sets[lap]].name, summary->content_hash,
                      lap_cost(*summary, static_cast<int>(lap)));
      for (const LapFigure& figure : kLapFigures) {
        const auto value = summary->number(fmt::format("lap{}_{}", lap + 1, figure.name));
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
      return mean.count;
    };
    figures[prefix + "laps"] = put(kLapFigures[0].name);
    for (const LapFigure& figure : kLapFigures) put(figure.name);
    put("cost");
  }
  return figures;
}

}  // namespace skein::campaign
