// SPDX-License-Identifier: Apache-2.0
// skein plan patrol: along a line, there and back or around.
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "app/common/commands.h"
#include "app/common/common.h"
#include "app/plan/conflicts.h"
#include "app/plan/document.h"
#include "app/plan/maps.h"
#include "app/plan/output.h"
#include "app/plan/task.h"
#include "skein/exchange/gis/zones.h"
#include "skein/exchange/table/text_shown.h"
#include "skein/solve/touring/patrol.h"

namespace skein::app {
namespace {

using Json = nlohmann::ordered_json;

solve::PatrolQuery query_of(const PlanPatrolArguments& arguments, const TaskInput& task,
                            const exchange::MapFeature& line) {
  solve::PatrolQuery query;
  query.line = line.points;
  query.closed = arguments.closed;
  // A line that ends where it begins is closed by itself.
  if (query.closed && query.line.size() > 2 && query.line.front() == query.line.back())
    query.line.pop_back();
  query.offset = arguments.offset;
  query.corners = arguments.corners == "flown-over" ? solve::PatrolCorners::kFlownOver
                                                    : solve::PatrolCorners::kRounded;
  query.tolerance = arguments.corner_tolerance;
  query.rounds = arguments.rounds;
  query.until = arguments.until;
  query.altitude_msl = task.altitude;
  query.start_time = arguments.setting.start_time;
  query.starts = task.starts;
  query.limits = task.limits;
  query.wind = task.setting.air.wind;
  return query;
}

Json about_patrol(const solve::PatrolResult& found) {
  Json about = {{"outcome", solve::name_of(found.outcome)}};
  if (!found.reason.empty()) about["reason"] = found.reason;
  if (found.plans.empty()) return about;
  about["round_s"] = found.round_time;
  about["interval_s"] = found.interval;
  about["largest_deviation_m"] = found.largest_deviation;
  about["flown_over_corners"] = found.flown_over;
  about["begins_s"] = found.begins;
  about["passes"] = found.passes;
  about["first_end_s"] = found.first_end;
  return about;
}

}  // namespace

int plan_patrol_command(const PlanPatrolArguments& arguments) {
  const auto task = read_task(arguments.setting, arguments.limits, arguments.starts,
                              arguments.output, files_of(arguments.maps, arguments.line));
  if (!task) return say_error(task.error());
  if (task.value().starts.empty())
    return say_error({ErrorCode::kBadInput, "--from", "is needed.",
                      "Give where each aircraft starts."});
  const auto features =
      read_features(arguments.line, arguments.maps, task.value().setting);
  if (!features) return say_error(features.error());
  const auto line = exchange::line_of(features.value());
  if (!line) return say_error(line.error());
  const auto airspace =
      read_airspace(arguments.maps, task.value().setting, task.value().has_altitude);
  if (!airspace) return say_error(airspace.error());
  const solve::PatrolQuery query = query_of(arguments, task.value(), line.value());
  const solve::PatrolResult found = solve::plan_patrol(query);
  Json about = about_patrol(found);
  // Planned without a single pass: somebody asked for too little time.
  if (found.plans.empty() || found.outcome == solve::PatrolOutcome::kNoTime)
    return say_no_plan(std::string(solve::name_of(found.outcome)), found.reason, about,
                       arguments.output, kBadUsage);
  exchange::Document document = document_of("Patrol of a line", task.value().setting,
                                            task.value().has_altitude, airspace.value());
  const std::string name = line.value().name.empty() ? "line" : line.value().name;
  document.shapes.push_back({name, false, false, line.value().points});
  add_flights(document, found.plans);
  document.facts = {
      {"Round", exchange::shown_time(found.round_time)},
      {"Off the line at most",
       fmt::format("{:.1f} m", std::ceil(found.largest_deviation * 10) / 10)}};
  if (found.plans.size() > 1)
    document.facts.emplace_back("Interval", exchange::shown_time(found.interval));
  add_facts(document, task.value().setting);
  const bool conflict =
      report_conflicts(found.plans, airspace.value(), task.value(), about);
  const int status = put_plan(document, about, arguments.output);
  return status == kDone && conflict ? static_cast<int>(kFailed) : status;
}

}  // namespace skein::app
