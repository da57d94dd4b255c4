// SPDX-License-Identifier: Apache-2.0
#include "skein/campaign/ground_starts/ground_starts_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "skein/base/random.h"
#include "skein/campaign/batch/data_fingerprint.h"
#include "skein/scenario/named_files.h"
#include "skein/scenario/scenario_file.h"

namespace skein::campaign {
namespace {

constexpr std::array kStartTurbulence = {"none", "light", "moderate", "severe"};
constexpr std::array kStands = {"into the wind", "any heading"};
constexpr double kMaxStartWind = 8;  // [m/s]
constexpr EntityId kStarter{1};      // the station is 0

// An aircraft of the study, with a route of its size.
struct Starter {
  const char* name;
  const char* plant;
  double side = 0;           // of the square that it flies [m]
  double altitude = 0;       // above ground [m]
  std::size_t roughest = 0;  // turbulence that it is started in, in kStartTurbulence
};

constexpr std::array kStarters = {
    Starter{"aerosonde", "{kind: fixed-wing, aircraft: aerosonde-stall}", 700, 100, 3},
    Starter{"bixler", "{kind: fixed-wing, aircraft: bixler}", 400, 80, 3},
    Starter{"light-sport", "{kind: fixed-wing, aircraft: light-sport}", 2000, 200, 3},
    Starter{"quad", "{kind: multirotor, aircraft: quad}", 120, 60, 3}};

std::vector<const Starter*> chosen(const std::vector<std::string>& names) {
  std::vector<const Starter*> all;
  for (const Starter& each : kStarters)
    if (names.empty() || std::find(names.begin(), names.end(), each.name) != names.end())
      all.push_back(&each);
  return all;
}

std::optional<Error> unknown(const std::vector<std::string>& names) {
  for (const std::string& name : names)
    if (chosen({name}).empty())
      return Error{ErrorCode::kBadInput, name, "is no aircraft of this study.",
                   "There are: aerosonde bixler light-sport quad."};
  return std::nullopt;
}

// What one seed draws.
struct Draw {
  std::size_t aircraft = 0, turbulence = 0, stand = 0;
  double wind = 0, from = 0, heading = 0;  // [m/s], [deg]
};

Draw draw(int seed, const std::vector<const Starter*>& starters) {
  RandomStream random(static_cast<std::uint64_t>(seed), 1, Purpose::kStudy);
  const auto pick = [&](std::size_t count) {
    return std::min(
        static_cast<std::size_t>(random.uniform() * static_cast<double>(count)),
        count - 1);
  };
  Draw d;
  d.aircraft = pick(starters.size());
  d.turbulence = pick(starters[d.aircraft]->roughest + 1);
  d.stand = pick(kStands.size());
  d.wind = random.uniform(0, kMaxStartWind);
  d.from = random.uniform(0, 360);
  d.heading = random.uniform(0, 360);
  return d;
}

std::vector<scenario::Override> overrides_of(const Draw& d, const Starter& aircraft,
                                             int seed) {
  const std::string turbulence = kStartTurbulence[d.turbulence];
  const std::string heading =
      d.stand == 0 ? std::string("null") : fmt::format("{:.1f}", d.heading);
  return {{fmt::format("aircraft[0].plant={}", aircraft.plant)},
          {fmt::format("aircraft[0].altitude_agl_m={}", aircraft.altitude)},
          {fmt::format("aircraft[0].agent={{kind: route, points_m: [[{0}, 0], [{0}, "
                       "{0}], [0, {0}], [0, 0]], laps: 1}}",
                       aircraft.side)},
          {fmt::format("aircraft[0].start.heading_deg={}", heading)},
          {turbulence == "none"
               ? std::string("environment.turbulence=none")
               : fmt::format("environment.turbulence={{kind: dryden, intensity: {}}}",
                             turbulence)},
          {fmt::format("environment.wind={{kind: uniform, speed_mps: {:.3f}, from_deg: "
                       "{:.1f}}}",
                       d.wind, d.from)},
          {fmt::format("seed={}", seed)}};
}

}  // namespace

Result<StudyPlan> plan_ground_starts_study(const GroundStartsStudy& study,
                                           const ScenarioReader& reader) {
  if (auto error = unknown(study.aircraft)) return *error;
  const std::vector<const Starter*> starters = chosen(study.aircraft);
  StudyPlan plan;
  std::map<std::array<std::size_t, 3>, std::size_t> cells;
  for (std::size_t a = 0; a < starters.size(); ++a)
    for (std::size_t t = 0; t <= starters[a]->roughest; ++t)
      for (std::size_t s = 0; s < kStands.size(); ++s) {
        cells[{a, t, s}] = plan.cells.size();
        plan.cells.push_back({starters[a]->name, kStartTurbulence[t], kStands[s], {}});
      }
  DataFingerprint data;
  for (int k = 0; k < study.seeds; ++k) {
    const int seed = study.first_seed + k;
    const Draw d = draw(seed, starters);
    const Starter& aircraft = *starters[d.aircraft];
    std::vector<scenario::Override> overrides = overrides_of(d, aircraft, seed);
    for (const std::string& text : study.overrides) overrides.push_back({text});
    auto read = reader.read(study.base, overrides);
    if (!read) return read.error();
    scenario::Scenario run = std::move(read).value();
    run.name =
        fmt::format("{}/{}/{}/{:.1f}/{}", aircraft.name, kStartTurbulence[d.turbulence],
                    kStands[d.stand], d.wind, seed);
    plan.cells[cells.at({d.aircraft, d.turbulence, d.stand})].items.push_back(
        plan.items.size());
    std::string text = scenario::write_scenario(run, reader.kinds());
    const auto files = data.of(scenario::named_files(run, reader.kinds()));
    if (!files) return files.error();
    plan.items.push_back({run.name, std::move(run), std::move(text), files.value()});
  }
  return plan;
}

StartWatch start_watch_of(const BatchItem& item) {
  StartLimits limits;
  // The ground is at 0, as it is in the base scenario.
  limits.altitude_msl = item.scenario.aircraft.at(0).altitude_agl;
  return {limits, kStarter};
}

namespace {

std::string causes_of_loss(const record::RunSummary& summary) {
  std::string all;
  for (const char* cause : {"accident", "tilt", "belief", "failsafe", "climb"})
    if (summary.number(std::string("lost_") + cause).value_or(0) > 0)
      all += (all.empty() ? "" : ", ") + std::string(cause);
  return all;
}

using Row = std::vector<record::TableCell>;

Row row_of(const StudyCell& cell, const std::vector<BatchOutcome>& outcomes) {
  const auto max = [&](const char* name) { return tally_of(cell, outcomes, name).max; };
  const FigureTally gone = tally_of(cell, outcomes, "lost");
  return {{cell.case_name},
          {cell.estimator},
          {cell.strategy},
          {gone.count},
          {gone.sum, gone.sum > 0},
          {max("tilt_max_deg")},
          {max("attitude_error_max_deg")},
          {max("believed_height_error_max_m")},
          {max("climb_time_s")}};
}

// A start that was lost.
Row row_of(const std::string& run, const record::RunSummary& summary) {
  const auto number = [&](const char* name) {
    return summary.number(name).value_or(std::nan(""));
  };
  return {{run},
          {causes_of_loss(summary)},
          {number("tilt_max_deg")},
          {number("attitude_error_max_deg")},
          {number("believed_height_error_max_m")}};
}

}  // namespace

record::StudyReport ground_starts_report(const StudyPlan& plan,
                                         const std::vector<BatchOutcome>& outcomes) {
  record::StudyReport report;
  report.title = "Starts from the ground";
  report.alert = partial_text(outcomes);
  report.intro = {
      "Whole aircraft with all their sensors, estimator and autopilot take off from flat "
      "ground in random wind and turbulence and fly a route; mass, inertia and each "
      "coefficient differ from what the autopilot was set up for.",
      "A start counts as lost after an accident, a failsafe, more than a second beyond "
      "75 degrees of tilt or with a belief that is wrong by 20 degrees of attitude or 25 "
      "m of height, or when the altitude is not reached within two minutes."};
  record::StudyTable table;
  table.title = "Losses and worst errors";
  table.columns = {"aircraft",
                   "turbulence",
                   "stands",
                   "runs",
                   "lost",
                   "tilt max [deg]",
                   "attitude error max [deg]",
                   "height error max [m]",
                   "climb max [s]"};
  table.caption = "Columns \"max\": the worst of all runs.";
  record::StudyTable lost;
  lost.title = "Starts that were lost";
  lost.columns = {"run", "cause", "tilt max [deg]", "attitude error [deg]",
                  "height error [m]"};
  double runs = 0, losses = 0;
  for (const StudyCell& cell : plan.cells) {
    const FigureTally gone = tally_of(cell, outcomes, "lost");
    runs += gone.count;
    losses += gone.sum;
    table.rows.push_back(row_of(cell, outcomes));
    for (const std::size_t item : cell.items) {
      const auto& summary = outcomes[item].summary;
      if (summary && summary->number("lost").value_or(0) > 0)
        lost.rows.push_back(row_of(plan.items[item].name, *summary));
    }
  }
  report.tables.push_back(std::move(table));
  if (!lost.rows.empty()) report.tables.push_back(std::move(lost));
  report.notes = {fmt::format("{:.0f} of {:.0f} starts were lost.", losses, runs)};
  return report;
}

}  // namespace skein::campaign
