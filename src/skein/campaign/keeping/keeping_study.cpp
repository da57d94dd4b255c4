// SPDX-License-Identifier: Apache-2.0
#include "skein/campaign/keeping/keeping_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "skein/campaign/batch/data_fingerprint.h"
#include "skein/scenario/named_files.h"
#include "skein/scenario/scenario_file.h"

namespace skein::campaign {
namespace {

constexpr EntityId kKept{1};  // the station is 0

// A part of a run that is varied: its name and what it changes of the base scenario.
struct Choice {
  const char* name;
  std::vector<std::string> overrides;
};

// What the aircraft keep to in the wind that they are measured in.
const std::vector<Choice>& aircraft_choices() {
  static const std::vector<Choice> all = {
      {"bixler", {}},
      {"quad",
       {"aircraft[0].plant=multirotor", "environment.wind.speed_mps=6", "duration_s=120",
        "aircraft[0].agent={kind: route, points_m: [[0, 0]]}"}}};
  return all;
}

const std::vector<Choice>& turbulence_choices() {
  static const std::vector<Choice> all = {
      {"none", {"environment.turbulence=none"}},
      {"light", {"environment.turbulence={kind: dryden, intensity: light}"}}};
  return all;
}

const std::vector<Choice>& receiver_choices() {
  static const std::vector<Choice> all = {
      {"true state", {"aircraft[0].sensors=[ideal-navigation]"}},
      {"rtk", {"aircraft[0].sensors=[{kind: flight, receiver: rtk}]"}},
      {"differential", {"aircraft[0].sensors=[{kind: flight, receiver: differential}]"}},
      {"single", {"aircraft[0].sensors=[{kind: flight, receiver: single}]"}}};
  return all;
}

Result<BatchItem> make_item(const KeepingStudy& study, const ScenarioReader& reader,
                            const std::vector<const Choice*>& choices, int seed,
                            DataFingerprint& data) {
  std::vector<scenario::Override> overrides;
  std::string name;
  for (const Choice* choice : choices) {
    for (const std::string& text : choice->overrides) overrides.push_back({text});
    name += fmt::format("{}/", choice->name);
  }
  overrides.push_back({fmt::format("seed={}", seed)});
  for (const std::string& text : study.overrides) overrides.push_back({text});
  auto read = reader.read(study.base, overrides);
  if (!read) return read.error();
  scenario::Scenario run = std::move(read).value();
  run.name = name + std::to_string(seed);
  std::string text = scenario::write_scenario(run, reader.kinds());
  const auto files = data.of(scenario::named_files(run, reader.kinds()));
  if (!files) return files.error();
  return BatchItem{run.name, std::move(run), std::move(text), files.value()};
}

constexpr std::array kFigures = {
    "straights_rms_m",  "turns_rms_m", "believed_rms_m",      "height_max_m",
    "airspeed_rms_mps", "hover_max_m", "hover_believed_max_m"};

}  // namespace

Result<StudyPlan> plan_keeping_study(const KeepingStudy& study,
                                     const ScenarioReader& reader) {
  const auto& all = aircraft_choices();
  for (const std::string& name : study.aircraft)
    if (std::none_of(all.begin(), all.end(),
                     [&](const Choice& each) { return each.name == name; }))
      return Error{ErrorCode::kBadInput, name, "is no aircraft of this study.",
                   "There are: bixler quad."};
  StudyPlan plan;
  DataFingerprint data;
  for (const Choice& aircraft : all) {
    if (!study.aircraft.empty() && std::find(study.aircraft.begin(), study.aircraft.end(),
                                             aircraft.name) == study.aircraft.end())
      continue;
    for (const Choice& turbulence : turbulence_choices())
      for (const Choice& receiver : receiver_choices()) {
        StudyCell cell{aircraft.name, turbulence.name, receiver.name, {}};
        for (int k = 0; k < study.seeds; ++k) {
          auto item = make_item(study, reader, {&aircraft, &turbulence, &receiver},
                                study.first_seed + k, data);
          if (!item) return item.error();
          cell.items.push_back(plan.items.size());
          plan.items.push_back(std::move(item).value());
        }
        plan.cells.push_back(std::move(cell));
      }
  }
  return plan;
}

KeepingWatch keeping_watch_of(const BatchItem& item) {
  Keeping keeping;
  keeping.aircraft = kKept;
  // The ground is at 0, as it is in the base scenario.
  keeping.altitude_msl = item.scenario.aircraft.at(0).altitude_agl;
  keeping.airspeed = 15;  // the bixler's cruise
  if (item.name.starts_with("quad")) keeping.hovers_at = Vec2(0, 0);
  return KeepingWatch(keeping);
}

record::StudyReport keeping_report(const StudyPlan& plan,
                                   const std::vector<BatchOutcome>& outcomes) {
  record::StudyReport report;
  report.title = "Tracking of commands";
  report.alert = partial_text(outcomes);
  report.intro = {
      "A glider flies around a square in 5 m/s of wind, a quadrotor hovers in 6 m/s: how "
      "far they truly are from their line, height, airspeed and place. A receiver's "
      "error "
      "is in that; what the autopilot believes shows control alone.",
      "Mean over the seeds, and the worst of them in brackets."};
  record::StudyTable table;
  table.title = "Errors";
  table.columns = {"aircraft",       "turbulence",
                   "receiver",       "straights rms [m]",
                   "turns rms [m]",  "believed rms [m]",
                   "height max [m]", "airspeed rms [m/s]",
                   "hover max [m]",  "hover believed max [m]"};
  for (const StudyCell& cell : plan.cells) {
    table.rows.push_back({{cell.case_name}, {cell.estimator}, {cell.strategy}});
    for (const char* figure : kFigures) {
      const FigureTally g = tally_of(cell, outcomes, figure);
      table.rows.back().push_back(
          {g.count == 0 ? std::string("-")
                        : fmt::format("{:.2f} ({:.2f})", g.mean(), g.max)});
    }
  }
  report.tables.push_back(std::move(table));
  return report;
}

std::map<std::string, double> keeping_figures(const StudyPlan& plan,
                                              const std::vector<BatchOutcome>& outcomes) {
  std::map<std::string, double> figures;
  for (const StudyCell& cell : plan.cells)
    for (const char* figure : kFigures) {
      const FigureTally g = tally_of(cell, outcomes, figure);
      if (g.count == 0) continue;
      const std::string name = fmt::format("{}/{}/{}/{}", cell.case_name, cell.estimator,
                                           cell.strategy, figure);
      figures[name + "_mean"] = g.mean();
      figures[name + "_max"] = g.max;
    }
  return figures;
}

}  // namespace skein::campaign
