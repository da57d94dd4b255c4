// SPDX-License-Identifier: Apache-2.0
// skein plan connect: the quickest Dubins flight between two poses in wind.
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "app/common/commands.h"
#include "app/common/common.h"
#include "app/plan/input.h"
#include "app/plan/output.h"
#include "skein/exchange/table/text_shown.h"
#include "skein/model/connection/airplane.h"
#include "skein/model/connection/arrival.h"
#include "skein/model/path/flight_plan.h"

namespace skein::app {
namespace {

using Json = nlohmann::ordered_json;

struct Connected {
  FlightPlan plan;
  Json about;
  std::string word;
  std::vector<std::pair<std::string, std::string>> facts;
};

model::Pose pose_of(const FlightState& state) {
  return {state.p_N.head<2>(), state.heading};
}

// Both ends at one altitude.
Connected level(const ReadEnds& ends, const model::AirMotion& air, double start) {
  const model::Connection found =
      model::connect(pose_of(ends.from), pose_of(ends.to), air);
  Connected result;
  result.plan =
      model::to_flight_plan(found, pose_of(ends.from), air, start, ends.from.p_N.z());
  result.word = model::name_of(found.word);
  result.about = {{"status", model::name_of(found.status)},
                  {"word", result.word},
                  {"time_s", found.time},
                  {"length_m", model::ground_length(result.plan)},
                  {"irregular", found.irregular}};
  if (found.irregular)
    result.facts.emplace_back("Irregular zone",
                              "yes: a flight that is no Dubins word may be quicker");
  return result;
}

Result<Connected> in_space(const ReadEnds& ends, const model::AirMotion& air,
                           double start, const PlanConnectArguments& arguments) {
  if (!arguments.climb || !arguments.sink)
    return Error{ErrorCode::kBadInput, arguments.climb ? "--sink" : "--climb",
                 fmt::format("is needed: the altitudes {} and {} m differ.",
                             0.0 - ends.from.p_N.z(), 0.0 - ends.to.p_N.z()),
                 "In m/s."};
  const model::SpaceConnection found =
      model::connect(ends.from, ends.to, air,
                     model::ClimbLimits{*arguments.climb, *arguments.sink,
                                        arguments.climb_acceleration});
  constexpr const char* kCases[] = {"low", "medium", "high"};
  const char* const altitude = kCases[static_cast<int>(found.altitude)];
  Connected result;
  result.plan = model::starting_at(found.plan, start);
  result.about = {{"status", model::name_of(found.status)},
                  {"time_s", found.time},
                  {"length_m", model::ground_length(result.plan)},
                  {"altitude_case", altitude}};
  result.facts.emplace_back("Altitude case", altitude);
  return result;
}

Result<Connected> at_time(const ReadEnds& ends, const model::AirMotion& air, double start,
                          double seconds) {
  const model::Arrival found =
      model::connect_at(pose_of(ends.from), pose_of(ends.to), air, seconds);
  if (found.status != model::ArrivalStatus::kFound) {
    const bool early = found.status == model::ArrivalStatus::kTooEarly;
    // Rounded up: what is shown can be flown.
    return Error{
        ErrorCode::kBadInput, "--arrive-s",
        fmt::format("{}; the quickest connection takes {:.9g} s.",
                    early ? fmt::format("{} s is too early", seconds)
                          : fmt::format("no path of just {} s was found", seconds),
                    std::ceil(found.earliest * 1000) / 1000),
        "Give another time."};
  }
  Connected result;
  result.plan = model::starting_at(found.plan, start);
  for (FlightElement& e : result.plan) e.p_N.z() = ends.from.p_N.z();
  result.about = {{"status", "found"},
                  {"time_s", seconds},
                  {"length_m", model::ground_length(result.plan)},
                  {"earliest_s", found.earliest}};
  result.facts.emplace_back("Quickest connection",
                            exchange::shown_time_below(found.earliest));
  return result;
}

Result<Connected> connected(const PlanConnectArguments& arguments, const ReadEnds& ends,
                            const model::AirMotion& air) {
  const bool level_flight = ends.from.p_N.z() == ends.to.p_N.z();
  const double start = arguments.setting.start_time;
  if (arguments.arrive && !level_flight)
    return Error{ErrorCode::kBadInput, "--arrive-s",
                 "is for flights at one altitude; the two ends differ.", ""};
  if (arguments.arrive) return at_time(ends, air, start, *arguments.arrive);
  if (!level_flight) return in_space(ends, air, start, arguments);
  return level(ends, air, start);
}

}  // namespace

int plan_connect_command(const PlanConnectArguments& arguments) {
  if (auto good = check_files(arguments.output, {}); !good)
    return say_error(good.error());
  const auto place = place_of(arguments.ends.from_geo);
  if (!place) return say_error(place.error());
  const auto setting = read_setting(arguments.setting, place.value());
  if (!setting) return say_error(setting.error());
  const auto ends = read_ends(arguments.ends, setting.value());
  if (!ends) return say_error(ends.error());
  const exchange::Known known{setting.value().frame.has_value(),
                              ends.value().has_altitude};
  if (auto good = check_formats(arguments.output, known); !good)
    return say_error(good.error());
  auto found = connected(arguments, ends.value(), setting.value().air);
  if (!found) return say_error(found.error());
  exchange::Document document;
  document.title = "Connection in wind";
  document.frame = setting.value().frame;
  document.has_altitude = ends.value().has_altitude;
  const FlightPlan& plan = found.value().plan;
  document.facts = {
      {"Time", exchange::shown_time(model::duration(plan))},
      {"Over ground", exchange::shown_length(model::ground_length(plan))},
      {"Airspeed", fmt::format("{:g} m/s", setting.value().air.airspeed)},
      {"Turn radius", fmt::format("{:g} m", setting.value().air.turn_radius)}};
  for (auto& fact : found.value().facts) document.facts.push_back(std::move(fact));
  document.plans.push_back({"flight", found.value().word, plan});
  using Kind = exchange::Mark::Kind;
  document.marks = {
      {Kind::kStart, "start", ends.value().from.p_N, ends.value().from.heading},
      {Kind::kGoal, "goal", ends.value().to.p_N, ends.value().to.heading}};
  return put_plan(document, found.value().about, arguments.output);
}

}  // namespace skein::app
