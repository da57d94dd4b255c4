// SPDX-License-Identifier: Apache-2.0
// skein plan orbit: circles or S-turns over a target that may move.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "app/common/commands.h"
#include "app/common/common.h"
#include "app/common/output.h"
#include "app/plan/conflicts.h"
#include "app/plan/document.h"
#include "app/plan/maps.h"
#include "app/plan/output.h"
#include "app/plan/task.h"
#include "skein/exchange/table/text_shown.h"
#include "skein/model/path/flight_plan.h"
#include "skein/solve/target/orbit.h"

namespace skein::app {
namespace {

using Json = nlohmann::ordered_json;
using solve::OrbitOutcome;

Result<solve::MovingTarget> target_of(const PlanOrbitArguments& arguments,
                                      const ReadSetting& setting) {
  solve::MovingTarget target;
  const auto place =
      read_point("target", arguments.target, arguments.target_geo, setting);
  if (!place) return place.error();
  target.at = {arguments.setting.start_time, place.value()};
  if (arguments.velocity.empty()) return target;
  const auto v =
      numbers_of("--target-velocity", arguments.velocity, 2, 2, "NORTH,EAST in m/s");
  if (!v) return v.error();
  target.velocity = {v.value()[0], v.value()[1]};
  return target;
}

solve::OrbitQuery query_of(const PlanOrbitArguments& arguments, const TaskInput& task) {
  solve::OrbitQuery query;
  query.kind =
      arguments.kind == "weave" ? solve::OrbitKind::kWeave : solve::OrbitKind::kCircle;
  query.side = arguments.side == "clockwise"       ? solve::OrbitSide::kClockwise
               : arguments.side == "anticlockwise" ? solve::OrbitSide::kAnticlockwise
                                                   : solve::OrbitSide::kEither;
  query.radius = arguments.radius;
  query.tolerance = arguments.error;
  query.duration = arguments.duration;
  query.altitude_msl = task.altitude;
  query.start_time = arguments.setting.start_time;
  query.start = task.starts[0];
  query.limits = task.limits;
  query.wind = task.setting.air.wind;
  return query;
}

Json about_orbit(const solve::OrbitResult& found) {
  Json about = {{"outcome", solve::name_of(found.outcome)}};
  if (!found.reason.empty()) about["reason"] = found.reason;
  if (found.min_radius > 0) about["min_radius_m"] = found.min_radius;
  if (found.plan.empty()) return about;
  about["airspeed_mps"] = found.airspeed;
  about["entry_s"] = found.entry_time;
  about["largest_error_m"] = found.largest_error;
  about["nearest_m"] = found.nearest;
  about["farthest_m"] = found.farthest;
  return about;
}

void add_target(exchange::Document& document, const solve::MovingTarget& target,
                double from, double until, double down) {
  const Vec2 begin = solve::position_at(target, from),
             end = solve::position_at(target, until);
  document.marks.push_back({exchange::Mark::Kind::kPlace,
                            "target",
                            {begin.x(), begin.y(), down},
                            std::nullopt});
  if ((end - begin).norm() > 0)
    document.shapes.push_back({"track of the target", false, false, {begin, end}});
}

}  // namespace

int plan_orbit_command(const PlanOrbitArguments& arguments) {
  const auto task = read_task(arguments.setting, arguments.limits, arguments.starts,
                              arguments.output, files_of(arguments.maps));
  if (!task) return say_error(task.error());
  if (task.value().starts.size() != 1)
    return say_error(
        {ErrorCode::kBadInput, "--from",
         fmt::format("{} starts given; one is needed.", task.value().starts.size()), ""});
  const auto target = target_of(arguments, task.value().setting);
  if (!target) return say_error(target.error());
  const auto airspace =
      read_airspace(arguments.maps, task.value().setting, task.value().has_altitude);
  if (!airspace) return say_error(airspace.error());
  solve::OrbitQuery query = query_of(arguments, task.value());
  query.target = target.value();
  const solve::OrbitResult found = solve::plan_orbit(query);
  Json about = about_orbit(found);
  const std::string outcome(solve::name_of(found.outcome));
  if (found.plan.empty())
    return say_no_plan(outcome, found.reason, about, arguments.output, kBadUsage);
  exchange::Document document = document_of("Orbit around a target", task.value().setting,
                                            task.value().has_altitude, airspace.value());
  add_flights(document, {found.plan});
  add_target(document, target.value(), query.start_time, model::end_time_of(found.plan),
             -query.altitude_msl);
  document.facts = {
      {"There after", exchange::shown_time(found.entry_time - query.start_time)},
      {"Distance", fmt::format("{:.1f} to {:.1f} m", found.nearest, found.farthest)},
      {"Flown at", fmt::format("{:g} m/s", found.airspeed)}};
  add_facts(document, task.value().setting);
  const bool conflict =
      report_conflicts({found.plan}, airspace.value(), task.value(), about);
  const int status = put_plan(document, about, arguments.output);
  if (found.outcome == OrbitOutcome::kPlanned && !conflict) return status;
  // Drawn, so that one sees where; it is no success.
  if (found.outcome != OrbitOutcome::kPlanned)
    complain("note: {}: {}\n", outcome, found.reason);
  return status == kDone ? static_cast<int>(kFailed) : status;
}

}  // namespace skein::app
