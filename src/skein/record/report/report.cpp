// SPDX-License-Identifier: Apache-2.0
#include "skein/record/report/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "skein/data/describe/json.h"
#include "skein/record/figures/mission/mission_figure_text.h"
#include "skein/record/report/page.h"
#include "skein/record/report/report_alerts.h"
#include "skein/record/report/report_radio.h"
#include "skein/record/store/run_reader.h"

namespace skein::record {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::size_t kLongestScenario = 200000;  // characters
constexpr std::size_t kMaxMetrics = 2000;         // samples over time
constexpr double kMinShare = 1.0 / 30;            // of the room of a page, for a map

const char* ending_name(RunEnding ending) {
  switch (ending) {
    case RunEnding::kComplete:
      return "complete";
    case RunEnding::kInterrupted:
      return "interrupted";
    case RunEnding::kCutOff:
      break;
  }
  return "cut off";
}

Json metrics_json(const StoredRun& run) {
  const std::size_t keep_each = run.metrics.size() / kMaxMetrics + 1;
  std::vector<float> times;
  for (std::size_t i = 0; i < run.metrics.size(); i += keep_each)
    times.push_back(static_cast<float>(run.metric_times[i]));
  Json columns = Json::object();
  for (const MetricField& field : metric_fields()) {
    std::vector<float> values;
    for (std::size_t i = 0; i < run.metrics.size(); i += keep_each)
      values.push_back(
          static_cast<float>((run.metrics[i].*field.value).value_or(std::nan(""))));
    columns[std::string(field.name) + std::string(field.unit)] = packed(values);
  }
  return {{"time_s", packed(times)}, {"columns", std::move(columns)}};
}

Json flights_json(const StoredRun& run) {
  Json flights = Json::array();
  for (const FlightSeries& flight : run.flights)
    flights.push_back({{"entity", flight.id.value},
                       {"time_s", packed(flight.time)},
                       {"columns",
                        {{"altitude_msl_m", packed(flight.altitude_msl)},
                         {"airspeed_mps", packed(flight.airspeed)},
                         {"cross_track_m", packed(flight.cross_track)},
                         {"position_error_m", packed(flight.position_error)},
                         {"charge", packed(flight.charge)},
                         {"reserve", packed(flight.reserve)}}}});
  return flights;
}

// A line of a chart; lines of one text share it.
struct SeriesLine {
  std::string name, text;
  std::vector<float> times, values;

  void add(double time, double value) {
    times.push_back(static_cast<float>(time));
    values.push_back(static_cast<float>(value));
  }
};

// Scores of forecasts, by the time that they were for.
void add_forecasts(const StoredRun& run, std::vector<SeriesLine>& lines) {
  struct Score {
    const char* text;
    std::optional<double> PerimeterMetrics::*value;
  };
  constexpr Score kScores[] = {
      {"forecasts: intersection over union", &PerimeterMetrics::iou},
      {"forecasts: share in the 95 % band", &PerimeterMetrics::coverage_95}};
  for (const Score& score : kScores) {
    std::map<std::string, SeriesLine> by_horizon;
    for (const ForecastScore& each : run.forecasts) {
      const double minutes = (each.time - each.made).seconds() / 60;
      const std::string name =
          fmt::format("{} {:g} min ahead", each.who.mission, minutes);
      SeriesLine& line = by_horizon[name];
      line.name = name;
      line.text = score.text;
      if (const auto value = each.metrics.*score.value)
        line.add(each.time.seconds(), *value);
    }
    for (auto& [name, line] : by_horizon) lines.push_back(std::move(line));
  }
}

// When fires were said to come to places, by the time when it was said.
void add_arrivals(const StoredRun& run, std::vector<SeriesLine>& lines) {
  struct Quantile {
    const char* name;
    std::optional<double> ArrivalForecast::*value;
  };
  constexpr Quantile kQuantiles[] = {{"10 %", &ArrivalForecast::early},
                                     {"50 %", &ArrivalForecast::middle},
                                     {"90 %", &ArrivalForecast::late}};
  std::map<std::tuple<std::string, std::string, std::string>, SeriesLine> all;
  for (const ArrivalForecast& arrival : run.arrivals)
    for (const Quantile& quantile : kQuantiles) {
      const auto at = arrival.*quantile.value;
      if (!at) continue;
      SeriesLine& line = all[{arrival.place, arrival.mission, quantile.name}];
      line.name = fmt::format("{} {}", arrival.mission, quantile.name);
      line.text = fmt::format("fire at {}, as forecast [min]", arrival.place);
      line.add(arrival.made.seconds(), *at / 60);
    }
  for (auto& [key, line] : all) lines.push_back(std::move(line));
}

// Figures of missions: over time, and what they say.
Json mission_figures_json(const StoredRun& run) {
  std::vector<SeriesLine> lines;
  for (const StoredSeries& each : run.mission_series)
    lines.push_back({each.mission, std::string(mission_figure_text(each.figure)),
                     each.times, each.values});
  add_forecasts(run, lines);
  add_arrivals(run, lines);
  Json series = Json::array(), texts = Json::object();
  for (const SeriesLine& line : lines)
    series.push_back({{"name", line.name},
                      {"text", line.text},
                      {"time_s", packed(line.times)},
                      {"values", packed(line.values)}});
  for (const auto& [name, value] : run.summary.numbers)
    if (const auto text = mission_number_text(name)) texts[name] = *text;
  return {{"series", std::move(series)}, {"texts", std::move(texts)}};
}

Json run_json(const StoredRun& run, const std::string& label, const fs::path& directory,
              Json map) {
  Json entities = Json::array(), events = Json::array();
  for (const EntityRecord& entity : run.entities) {
    entities.push_back(json::to_json(entity));
    entities.back()["class"] = class_of(entity.reality);
  }
  for (const Event& event : run.events) events.push_back(json::to_json(event));
  std::string scenario = run.info.scenario_text;
  if (scenario.size() > kLongestScenario)
    scenario =
        scenario.substr(0, kLongestScenario) + "\n... (cut here; see scenario.yaml)";
  return {{"label", label},
          {"name", run.info.name},
          {"version", run.info.version},
          {"seed", std::to_string(run.info.seed)},
          {"start_utc", run.info.start_utc},
          {"directory", directory.string()},
          {"content_hash", run.summary.content_hash},
          {"state", ending_name(run.ending)},
          {"duration_s", run.duration},
          {"allocation_start_s", run.allocation_start},  // NaN is written as null
          {"summary", run.summary.numbers},
          {"entities", std::move(entities)},
          {"metrics", metrics_json(run)},
          {"flights", flights_json(run)},
          {"missions", mission_figures_json(run)},
          {"messages",
           {{"bin_s", run.message_bin},
            {"sent", run.messages_sent},
            {"lost", run.messages_lost},
            {"bytes", run.messages_bytes}}},
          {"radio", radio_json(run)},
          {"events", std::move(events)},
          {"events_left_out", run.events_left_out},
          {"scenario", scenario},
          {"alerting", alerts_json(run)},
          {"map", std::move(map)}};
}

// The last part of each path, with as many parts before it as distinguish the runs.
std::vector<std::string> labels(std::span<const fs::path> directories) {
  for (int parts = 1;; ++parts) {
    std::vector<std::string> names;
    for (const fs::path& directory : directories) {
      fs::path rest = fs::absolute(directory / "x").lexically_normal().parent_path();
      fs::path name = rest.filename();
      for (int k = 1; k < parts && rest.has_parent_path(); ++k) {
        rest = rest.parent_path();
        name = rest.filename() / name;
      }
      names.push_back(name.string());
    }
    const std::set<std::string> different(names.begin(), names.end());
    if (different.size() == names.size() || parts == 6) return names;
  }
}

}  // namespace

Result<void> write_report(std::span<const fs::path> run_directories, const fs::path& html,
                          const MapOf& map_of) {
  if (run_directories.empty())
    return Error{ErrorCode::kBadInput, "", "no run was given",
                 "give directories of runs"};
  const std::vector<std::string> names = labels(run_directories);
  const std::size_t count = run_directories.size();
  ReadBudget budget;
  if (count > 1) budget.flights = 0;  // comparisons show their figures only
  // Many runs share the room of one page.
  const double share = std::max(kMinShare, 1.0 / static_cast<double>(count));

  Json runs = Json::array();
  std::vector<Error> errors;
  std::string title;
  for (std::size_t i = 0; i < run_directories.size(); ++i) {
    const auto run = read_run(run_directories[i], budget);
    if (!run) {
      errors.push_back(run.error());
      continue;
    }
    Json map;
    if (map_of) {
      auto packed = map_of(run_directories[i], share);
      if (!packed) {
        errors.push_back(packed.error());
        continue;
      }
      if (!packed.value().empty()) map = Json::parse(packed.value());
    }
    title = run.value().info.name.empty() ? names[i] : run.value().info.name;
    runs.push_back(run_json(run.value(), names[i], run_directories[i], std::move(map)));
  }
  if (!errors.empty()) {
    Error all = errors.front();
    for (std::size_t i = 1; i < errors.size(); ++i)
      all.message += "; " + errors[i].text();
    return all;
  }
  if (count > 1) title = "Comparison of " + std::to_string(count) + " runs";
  return write_page(PageKind::kRuns, title,
                    {{"page", "runs"}, {"title", title}, {"runs", std::move(runs)}},
                    html);
}

}  // namespace skein::record
