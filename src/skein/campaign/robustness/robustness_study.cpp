// SPDX-License-Identifier: Apache-2.0
#include "skein/campaign/robustness/robustness_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "skein/base/check.h"
#include "skein/base/random.h"
#include "skein/campaign/batch/data_fingerprint.h"
#include "skein/scenario/named_files.h"
#include "skein/scenario/scenario_file.h"

namespace skein::campaign {
namespace {

constexpr std::array kTurbulence = {"none", "light", "moderate", "severe"};
constexpr double kMaxWindSpeed = 8;  // [m/s]
constexpr EntityId kSubject{1};      // the station is 0

const RobustAircraft& aircraft_called(const std::vector<RobustAircraft>& all,
                                      const std::string& name) {
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const auto& a) { return a.name == name; });
  SKEIN_CHECK(found != all.end(), name);
  return *found;
}

std::string turbulence_text(const std::string& name) {
  if (name == "none") return "environment.turbulence=none";
  return fmt::format("environment.turbulence={{kind: dryden, intensity: {}}}", name);
}

// The corners of a square, flown from the origin, where the aircraft starts.
std::string route_text(double side, int laps) {
  return fmt::format(
      "aircraft[0].agent={{kind: route, points_m: [[{0}, 0], [{0}, {0}], [0, {0}], "
      "[0, 0]], laps: {1}}}",
      side, laps);
}

}  // namespace

std::vector<RobustAircraft> robust_aircraft() {
  return {{"aerosonde",
           {"aircraft[0].plant={kind: fixed-wing, aircraft: aerosonde-stall}",
            route_text(700, 2)},
           false,
           11.6},
          {"bixler",
           {"aircraft[0].plant={kind: fixed-wing, aircraft: bixler}", route_text(400, 2)},
           false,
           6.9},
          {"quad",
           {"aircraft[0].plant={kind: multirotor, aircraft: quad}", route_text(120, 2)},
           true,
           0}};
}

Result<StudyPlan> plan_robustness_study(const RobustnessStudy& study,
                                        const ScenarioReader& reader) {
  const std::vector<RobustAircraft> all = robust_aircraft();
  std::vector<std::string> names = study.aircraft;
  if (names.empty())
    for (const RobustAircraft& each : all) names.push_back(each.name);
  for (const std::string& name : names)
    if (std::none_of(all.begin(), all.end(),
                     [&](const auto& a) { return a.name == name; }))
      return Error{ErrorCode::kBadInput, name, "is no aircraft of this study.",
                   "There are: aerosonde bixler quad."};
  StudyPlan plan;
  for (const std::string& name : names)
    for (const char* turbulence : kTurbulence)
      for (const char* wind : {"0-4", "4-8"})
        plan.cells.push_back({name, turbulence, wind, {}});

  DataFingerprint data;
  for (int k = 0; k < study.seeds; ++k) {
    const int seed = study.first_seed + k;
    RandomStream random(static_cast<std::uint64_t>(seed), 0, Purpose::kStudy);
    const auto pick = [&](std::size_t count) {
      return std::min(
          static_cast<std::size_t>(random.uniform() * static_cast<double>(count)),
          count - 1);
    };
    const std::size_t which = pick(names.size()), rough = pick(kTurbulence.size());
    const double wind = random.uniform(0, kMaxWindSpeed), from = random.uniform(0, 360);
    std::vector<scenario::Override> overrides;
    for (const std::string& text : aircraft_called(all, names[which]).overrides)
      overrides.push_back({text});
    overrides.push_back({turbulence_text(kTurbulence[rough])});
    overrides.push_back(
        {fmt::format("environment.wind={{kind: uniform, speed_mps: {:.3f}, from_deg: "
                     "{:.1f}}}",
                     wind, from)});
    overrides.push_back({fmt::format("seed={}", seed)});
    for (const std::string& text : study.overrides) overrides.push_back({text});
    auto read = reader.read(study.base, overrides);
    if (!read) return read.error();
    scenario::Scenario run = std::move(read).value();
    const std::size_t cell =
        (which * kTurbulence.size() + rough) * 2 + (wind < kMaxWindSpeed / 2 ? 0 : 1);
    run.name =
        fmt::format("{}/{}/{:.1f}/{}", names[which], kTurbulence[rough], wind, seed);
    plan.cells[cell].items.push_back(plan.items.size());
    std::string text = scenario::write_scenario(run, reader.kinds());
    const auto files = data.of(scenario::named_files(run, reader.kinds()));
    if (!files) return files.error();
    plan.items.push_back({run.name, std::move(run), std::move(text), files.value()});
  }
  return plan;
}

FlightWatch watch_of(const BatchItem& item) {
  const std::vector<RobustAircraft> all = robust_aircraft();
  const RobustAircraft& aircraft =
      aircraft_called(all, item.name.substr(0, item.name.find('/')));
  ControlLimits limits;
  limits.stall = aircraft.stall;
  const Vec2 end = Vec2::Zero();  // of every route
  // The ground is at 0, as it is in the base scenario.
  return {limits, kSubject, item.scenario.aircraft.at(0).altitude_agl,
          aircraft.hovers ? &end : nullptr};
}

namespace {

std::string causes(const record::RunSummary& summary) {
  std::string all;
  for (const char* cause : {"accident", "tilt", "slow", "height", "track"})
    if (summary.number(std::string("lost_") + cause).value_or(0) > 0)
      all += (all.empty() ? "" : ", ") + std::string(cause);
  return all;
}

}  // namespace

record::StudyReport robustness_report(const StudyPlan& plan,
                                      const std::vector<BatchOutcome>& outcomes) {
  record::StudyReport report;
  report.title = "Robustness";
  report.alert = partial_text(outcomes);
  report.intro = {
      "Whole aircraft with all their sensors, estimator and autopilot fly a route in "
      "random wind and turbulence; mass, inertia and each coefficient differ from what "
      "the autopilot was set up for.",
      "Control counts as lost after an accident, more than a second beyond 75 degrees of "
      "tilt, two seconds below the stall speed, or when the true height is 30 m or the "
      "place 60 m off."};
  record::StudyTable table;
  table.title = "Losses of control and worst errors";
  table.columns = {"aircraft",       "turbulence",     "wind [m/s]",   "runs",
                   "lost",           "tilt max [deg]", "slow max [s]", "height max [m]",
                   "height rms [m]", "track max [m]",  "track rms [m]"};
  record::StudyTable lost;
  lost.title = "Runs that lost control";
  lost.columns = {"run",      "cause",      "tilt max [deg]",
                  "slow [s]", "height [m]", "track [m]"};
  double runs = 0, losses = 0;
  for (const StudyCell& cell : plan.cells) {
    const auto of = [&](const char* name) { return tally_of(cell, outcomes, name); };
    const auto mean = [&](const char* name) { return of(name).mean(); };
    const auto max = [&](const char* name) { return of(name).max; };
    const FigureTally gone = of("lost");
    runs += gone.count;
    losses += gone.sum;
    table.rows.push_back({{cell.case_name},
                          {cell.estimator},
                          {cell.strategy},
                          {gone.count},
                          {gone.sum, gone.sum > 0},
                          {max("tilt_max_deg")},
                          {max("slow_longest_s")},
                          {max("height_error_max_m")},
                          {mean("height_error_rms_m")},
                          {max("track_error_max_m")},
                          {mean("track_error_rms_m")}});
    for (const std::size_t item : cell.items) {
      const auto& summary = outcomes[item].summary;
      if (!summary || summary->number("lost").value_or(0) <= 0) continue;
      const auto number = [&](const char* name) {
        return summary->number(name).value_or(std::nan(""));
      };
      lost.rows.push_back({{plan.items[item].name},
                           {causes(*summary)},
                           {number("tilt_max_deg")},
                           {number("slow_longest_s")},
                           {number("height_error_max_m")},
                           {number("track_error_max_m")}});
    }
  }
  table.caption = "Columns \"max\": the worst of all runs; \"rms\": mean over the runs.";
  report.tables.push_back(std::move(table));
  if (!lost.rows.empty()) report.tables.push_back(std::move(lost));
  report.notes = {fmt::format("{:.0f} of {:.0f} runs lost control.", losses, runs)};
  return report;
}

}  // namespace skein::campaign
