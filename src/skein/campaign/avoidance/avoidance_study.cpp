// SPDX-License-Identifier: Apache-2.0
#include "skein/campaign/avoidance/avoidance_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "skein/base/math.h"
#include "skein/campaign/batch/data_fingerprint.h"
#include "skein/scenario/named_files.h"
#include "skein/scenario/scenario_file.h"

namespace skein::campaign {
namespace {

constexpr double kSlowest = 15, kFastest = 25;  // of the aircraft of the cases [m/s]
// Which airframe flies a case: with something in reserve at both ends [m/s].
constexpr double kSlowFrom = 14, kFastFrom = 26;
constexpr double kTurnRadius = 60;              // [m]
constexpr double kClimb = 3;                    // [m/s]
constexpr double kSlack = 1.6, kMoreTime = 60;  // of the time that a run may take, [s]

double degrees(double radians) {
  return radians * 180 / geo::kPi;
}

// The heading with which the wind carries it straight to its goal.
double heading_of(const AvoidanceAircraft& aircraft, const Vec2& wind) {
  const Vec2 way = (aircraft.goal - aircraft.start).head<2>();
  const Vec2 along = way.normalized();
  const double across = wind.dot(geo::turned_right(along));
  return geo::bearing(way) -
         math::asin(std::clamp(across / aircraft.airspeed, -1.0, 1.0));
}

// The sensor for intruders; none where there is nobody to find.
std::string sensor_of(const AvoidanceStudy& study) {
  const std::string range =
      study.range > 0 ? fmt::format(", range_m: {:.17g}", study.range) : "";
  if (study.tracks == "adsb") return "{kind: ads-b-in" + range + "}";
  if (study.tracks == "perfect")
    return "{kind: ads-b-in, reception: 1, latency_s: 0, best_position_sd_m: 0.01, "
           "worst_position_sd_m: 0.01, altitude_sd_m: 0.01, velocity_sd_mps: 0.01" +
           range + "}";
  return "{kind: " + study.tracks + range + "}";
}

std::string plant_of(const AvoidanceStudy& study, const AvoidanceAircraft& aircraft,
                     const std::string& sensor) {
  const double v = aircraft.airspeed;
  const std::string more = sensor.empty() ? "" : ", " + sensor;
  if (study.plant == "fixed-wing")
    return fmt::format(
        "plant: {{kind: fixed-wing, aircraft: {}}}\n    autopilot: skein\n    "
        "sensors: [flight{}]",
        v < kSlowFrom ? "bixler" : (v < kFastFrom ? "x8" : "aerosonde"), more);
  const double range = std::max(0.05, std::min(v - kSlowest, kFastest - v) / v);
  return fmt::format(
      "plant: {{kind: kinematic, airspeed_mps: {:.17g}, airspeed_range: {:.17g}, "
      "turn_radius_m: {}, climb_rate_mps: {}}}\n    "
      "sensors: [{{kind: gnss, position_sd_m: 0, altitude_sd_m: 0, velocity_sd_mps: 0}}, "
      "{{kind: air-data}}{}]",
      v, range, kTurnRadius, kClimb, more);
}

std::string traffic_of(const AvoidanceIntruder& intruder, std::size_t number) {
  const Vec2 along = intruder.v_N.head<2>();
  std::string turns;
  if (const auto& turn = intruder.turn)
    turns = fmt::format(
        ", turns: [{{from_s: {:.17g}, for_s: {:.17g}, turn_rate_deg_per_s: {:.17g}, "
        "climb_mps: {:.17g}}}]",
        turn->from, turn->duration, degrees(turn->rate), turn->climb);
  return fmt::format(
      "  - name: intruder-{}\n    position_m: [{:.17g}, {:.17g}]\n    altitude_msl_m: "
      "{:.17g}\n    flight: {{kind: straight, speed_mps: {:.17g}, course_deg: {:.17g}, "
      "climb_mps: {:.17g}{}}}\n",
      number, intruder.p_N.x(), intruder.p_N.y(), -intruder.p_N.z(), along.norm(),
      degrees(geo::wrap_pi(geo::bearing(along))), -intruder.v_N.z(), turns);
}

std::string scenario_of(const AvoidanceStudy& study, const AvoidanceCase& flown) {
  const Vec2 wind = flown.wind;
  double longest = 0;
  for (const AvoidanceAircraft& each : flown.aircraft)
    longest = std::max(longest, undisturbed_time(each, wind));
  std::string text = fmt::format(
      "name: \"{}\"\nduration_s: {:.0f}\nseed: {}\nmissions: []\nrecord: {{rate_hz: 2}}\n"
      "radio: {{kind: ideal, loss: {:.17g}, delay_s: {:.17g}, range_m: {:.17g}}}\n"
      "environment:\n  terrain: flat\n  phenomena: []\n"
      "  wind: {{kind: uniform, speed_mps: {:.17g}, from_deg: {:.17g}}}\n"
      "  turbulence: {}\naircraft:\n",
      flown.name, std::ceil(kSlack * longest + kMoreTime), study.seed, study.loss,
      study.delay, study.range, wind.norm(),
      wind.norm() > 0 ? degrees(geo::wrap_2pi(geo::bearing(-wind))) : 0.0,
      study.turbulence == "none"
          ? std::string("none")
          : fmt::format("{{kind: dryden, intensity: {}}}", study.turbulence));
  const std::string sensor = flown.intruders.empty() ? "" : sensor_of(study);
  for (std::size_t k = 0; k < flown.aircraft.size(); ++k) {
    const AvoidanceAircraft& each = flown.aircraft[k];
    text += fmt::format(
        "  - name: a{}\n    {}\n    altitude_agl_m: {:.17g}\n"
        "    agent: {{kind: direct, point_m: [{:.17g}, {:.17g}], altitude_msl_m: "
        "{:.17g}, airspeed_mps: {:.17g}, stays: false, "
        "avoidance: {{method: {}, deal: {}, intruder_room: {}, horizontal_m: {:.17g}, "
        "vertical_m: {:.17g}, horizon_s: {:.17g}}}}}\n"
        "    start: {{placement: list, positions_m: [[{:.17g}, {:.17g}]], "
        "altitude_msl_m: {:.17g}, heading_deg: {:.17g}}}\n",
        k + 1, plant_of(study, each, sensor), -each.start.z(), each.goal.x(),
        each.goal.y(), -each.goal.z(), each.airspeed, study.method, study.deal,
        study.room, study.separation.horizontal, study.separation.vertical, study.horizon,
        each.start.x(), each.start.y(), -each.start.z(),
        degrees(geo::wrap_pi(heading_of(each, wind))));
  }
  if (!flown.intruders.empty()) text += "traffic:\n";
  for (std::size_t k = 0; k < flown.intruders.size(); ++k)
    text += traffic_of(flown.intruders[k], k + 1);
  return text;
}

std::optional<Error> refuse(const AvoidanceStudy& study) {
  if (study.plant != "path" && study.plant != "fixed-wing")
    return Error{ErrorCode::kBadInput, "plant", "\"" + study.plant + "\" is no plant.",
                 "There are: path fixed-wing."};
  constexpr std::array<std::string_view, 4> kTracks = {"perfect", "adsb", "passive",
                                                       "radar"};
  if (std::ranges::find(kTracks, study.tracks) == kTracks.end())
    return Error{ErrorCode::kBadInput, "tracks", "\"" + study.tracks + "\" finds nobody.",
                 "There are: perfect adsb passive radar."};
  for (const AvoidanceCase& each : study.cases)
    for (const AvoidanceAircraft& aircraft : each.aircraft)
      if (each.wind.norm() >= aircraft.airspeed)
        return Error{ErrorCode::kBadInput, each.name,
                     fmt::format("has a wind of {:.1f} m/s and an aircraft that flies "
                                 "{:.1f} m/s.",
                                 each.wind.norm(), aircraft.airspeed),
                     "Aircraft must fly faster than the wind."};
  return std::nullopt;
}

}  // namespace

double undisturbed_time(const AvoidanceAircraft& aircraft, const Vec2& wind) {
  const Vec2 way = (aircraft.goal - aircraft.start).head<2>();
  const Vec2 along = way.normalized();
  const double with = wind.dot(along), across = wind.dot(geo::turned_right(along));
  return way.norm() /
         (with + std::sqrt(aircraft.airspeed * aircraft.airspeed - across * across));
}

Separation separation_of(const AvoidanceStudy& study, const AvoidanceCase& flown) {
  if (flown.intruders.empty()) return study.separation;
  return larger(study.separation, *separation_named("well-clear"));
}

Result<StudyPlan> plan_avoidance_study(const AvoidanceStudy& study,
                                       const ScenarioReader& reader) {
  if (auto error = refuse(study)) return *error;
  const scenario::KindTable& kinds = reader.kinds();
  StudyPlan plan;
  DataFingerprint data;
  plan.cells.push_back({"all", study.method, study.plant, {}});
  for (const AvoidanceCase& each : study.cases) {
    if (auto going = reader.go_on(); !going) return going.error();
    auto read =
        scenario::read_scenario_text(scenario_of(study, each), each.name, ".", kinds);
    if (!read.ok()) return Error{ErrorCode::kBadInput, "", read.report(), ""};
    scenario::Scenario run = *std::move(read.scenario);
    std::string text = scenario::write_scenario(run, kinds);
    const auto files = data.of(scenario::named_files(run, kinds));
    if (!files) return files.error();
    plan.cells.front().items.push_back(plan.items.size());
    plan.items.push_back({each.name, std::move(run), std::move(text), files.value()});
  }
  return plan;
}

std::string avoidance_csv(const AvoidanceStudy& study, const StudyPlan& plan,
                          const std::vector<BatchOutcome>& outcomes) {
  constexpr std::array kNames = {"min_ratio",
                                 "min_horizontal_m",
                                 "violations",
                                 "nmac",
                                 "lowc",
                                 "extra_time_s",
                                 "extra_percent",
                                 "arrived",
                                 "avoidance_messages",
                                 "avoidance_bytes",
                                 "worst_decision_ms",
                                 "least_fixed_before_s",
                                 "worst_extra_percent",
                                 "worst_extra_time_s",
                                 "conflicts",
                                 "deals",
                                 "decision_ms_per_s",
                                 "cost_s"};
  std::string text =
      "case,method,min_ratio,min_horizontal_m,violations,nmac,lowc,extra_time_s,"
      "extra_percent,arrived,messages,bytes,worst_decision_ms,least_fixed_before_s,"
      "worst_extra_percent,worst_extra_time_s,conflicts,deals,decision_ms_per_s,"
      "cost_s\n";
  for (std::size_t k = 0; k < plan.items.size(); ++k) {
    if (!outcomes[k].summary) continue;
    text += plan.items[k].name + "," + study.method;
    for (const char* name : kNames) {
      text += ',';
      if (const auto value = outcomes[k].summary->number(name))
        fmt::format_to(std::back_inserter(text), "{:.6g}", *value);
    }
    text += '\n';
  }
  return text;
}

namespace {

// Of the runs of one kind of case.
struct KindTally {
  double cases = 0, violations = 0, nmac = 0, lowc = 0;
  double extra = 0, percent = 0, with_extra = 0, worst_percent = 0, worst_time = 0;
  double min_ratio = 1e9, least_fixed = 1e9, decision = 0, bytes = 0, deals = 0;

  void add(const record::RunSummary& run) {
    const auto number = [&](const char* name) { return run.number(name).value_or(0); };
    cases += 1;
    violations += number("violations");
    nmac += number("nmac");
    lowc += number("lowc");
    if (const auto value = run.number("extra_percent")) {
      with_extra += 1;
      percent += *value;
      extra += number("extra_time_s");
      worst_percent = std::max(worst_percent, number("worst_extra_percent"));
      worst_time = std::max(worst_time, number("worst_extra_time_s"));
    }
    min_ratio = std::min(min_ratio, number("min_ratio"));
    least_fixed = std::min(least_fixed, run.number("least_fixed_before_s").value_or(1e9));
    decision = std::max(decision, number("worst_decision_ms"));
    bytes += number("avoidance_bytes");
    deals += number("deals");
  }
};

}  // namespace

record::StudyTable avoidance_table(const StudyPlan& plan,
                                   const std::vector<BatchOutcome>& outcomes) {
  std::map<std::string, KindTally> kinds;
  for (std::size_t k = 0; k < plan.items.size(); ++k)
    if (outcomes[k].summary)
      kinds[plan.items[k].name.substr(0, plan.items[k].name.rfind('-'))].add(
          *outcomes[k].summary);
  record::StudyTable table;
  table.title = "Keeping apart";
  table.columns = {"kind",          "cases",     "violations", "nmac",      "min ratio",
                   "extra [s]",     "worst [s]", "extra [%]",  "worst [%]", "fixed [s]",
                   "decision [ms]", "kB",        "deals"};
  const auto known = [](double value) { return value < 1e9 ? value : std::nan(""); };
  for (const auto& [name, tally] : kinds) {
    const double n = std::max(1.0, tally.with_extra);
    table.rows.push_back({{name},
                          {tally.cases},
                          {tally.violations},
                          {tally.nmac},
                          {known(tally.min_ratio)},
                          {tally.extra / n},
                          {tally.worst_time},
                          {tally.percent / n},
                          {tally.worst_percent},
                          {known(tally.least_fixed)},
                          {tally.decision},
                          {tally.bytes / 1000},
                          {tally.deals}});
  }
  return table;
}

}  // namespace skein::campaign
