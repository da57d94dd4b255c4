// SPDX-License-Identifier: Apache-2.0
// skein plan coverage: parallel sweeps over an area.
#include <fmt/format.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "app/common/commands.h"
#include "app/common/common.h"
#include "app/common/output.h"
#include "app/plan/document.h"
#include "app/plan/maps.h"
#include "app/plan/output.h"
#include "app/plan/task.h"
#include "skein/assemble/kinds/planner_kinds.h"
#include "skein/exchange/gis/zones.h"
#include "skein/exchange/table/text_shown.h"
#include "skein/solve/coverage/coverage.h"

namespace skein::app {
namespace {

using Json = nlohmann::ordered_json;
using solve::CoverageOutcome;

Result<std::vector<solve::CoverageAircraft>> aircraft_of(
    const PlanCoverageArguments& arguments, const TaskInput& task) {
  std::vector<solve::CoverageAircraft> aircraft;
  for (const FlightState& start : task.starts) {
    aircraft.push_back({start, std::nullopt});
    if (arguments.back) aircraft.back().end = start;
  }
  if (arguments.back && aircraft.empty())
    return Error{ErrorCode::kBadInput, "--return", "needs --from.", ""};
  if (!aircraft.empty() && arguments.aircraft != 1 &&
      static_cast<std::size_t>(arguments.aircraft) != aircraft.size())
    return Error{
        ErrorCode::kBadInput, "--aircraft",
        fmt::format("{}, but there are {} starts.", arguments.aircraft, aircraft.size()),
        "Give one --from for each, or none."};
  if (aircraft.empty()) aircraft.resize(static_cast<std::size_t>(arguments.aircraft));
  return aircraft;
}

solve::CoverageQuery query_of(const PlanCoverageArguments& arguments,
                              const TaskInput& task, const exchange::MapFeature& area) {
  solve::CoverageQuery query;
  query.area = area.points;
  query.holes = area.holes;
  query.swath = arguments.swath;
  query.overlap = arguments.overlap;
  query.overshoot = arguments.overshoot;
  query.zone_distance = arguments.zone_distance;
  query.altitude_msl = task.altitude;
  query.start_time = arguments.setting.start_time;
  query.limits = task.limits;
  query.wind = task.setting.air.wind;
  if (arguments.bearing_deg) query.bearing = geo::radians(*arguments.bearing_deg);
  return query;
}

Json about_coverage(const solve::CoverageResult& found) {
  Json about = {{"outcome", solve::name_of(found.outcome)}};
  if (!found.reason.empty()) about["reason"] = found.reason;
  if (!found.plans.empty()) {
    about["longest_s"] = found.longest;
    about["total_s"] = found.total;
    about["bearing_deg"] = geo::degrees(found.bearing);
    about["lines"] = found.lines;
    about["on_lines_s"] = found.on_lines;
    about["area_m2"] = found.area;
    about["covered_share"] = found.covered_share;
    about["in_zones_s"] = found.in_zones;
  }
  return about;
}

// Zones keep lines away; what lies beside them may then not be seen.
void note_missed(const PlanCoverageArguments& arguments,
                 const solve::CoverageResult& found) {
  constexpr double kAll = 0.9995;
  if (arguments.maps.zones.empty() || found.covered_share >= kAll) return;
  const double missed = 1 - found.covered_share;
  complain(
      "note: {:.2f} % of the area ({:.4g} m²) is not covered: lines keep {:g} m from "
      "zones (--zone-distance-m), and room to turn before them.\n",
      100 * missed, missed * found.area, arguments.zone_distance);
}

int put_coverage(const PlanCoverageArguments& arguments, const TaskInput& task,
                 const exchange::MapFeature& area, const Airspace& airspace,
                 const solve::CoverageResult& found) {
  const Json about = about_coverage(found);
  const std::string outcome(solve::name_of(found.outcome));
  if (found.plans.empty())
    return say_no_plan(outcome, found.reason, about, arguments.output, kBadUsage);
  exchange::Document document =
      document_of("Coverage of an area", task.setting, task.has_altitude, airspace);
  document.shapes.push_back(
      {area.name.empty() ? "area" : area.name, true, false, area.points});
  for (const geo::Ring& hole : area.holes)
    document.shapes.push_back({"left out", true, true, hole});
  add_flights(document, found.plans);
  document.facts = {{"Lines", fmt::format("{}", found.lines)},
                    {"Bearing", fmt::format("{:.1f}°", geo::degrees(found.bearing))},
                    {"Area", fmt::format("{:.4g} km²", found.area / 1e6)},
                    {"Covered", fmt::format("{:.2f} %", 100 * found.covered_share)}};
  if (found.outcome != CoverageOutcome::kPlanned) {
    complain("note: {}: {}\n", outcome, found.reason);
    document.facts.emplace_back("Within zones", exchange::shown_time(found.in_zones));
  }
  add_facts(document, task.setting);
  note_missed(arguments, found);
  const int status = put_plan(document, about, arguments.output);
  // A plan that enters a zone is drawn, so that one sees where; it is no success.
  return status == kDone && found.outcome != CoverageOutcome::kPlanned
             ? static_cast<int>(kFailed)
             : status;
}

}  // namespace

int plan_coverage_command(const PlanCoverageArguments& arguments,
                          const std::atomic<bool>& stop) {
  const auto task = read_task(arguments.setting, arguments.limits, arguments.starts,
                              arguments.output, files_of(arguments.maps, arguments.area));
  if (!task) return say_error(task.error());
  const auto features =
      read_features(arguments.area, arguments.maps, task.value().setting);
  if (!features) return say_error(features.error());
  const auto area = exchange::area_of(features.value());
  if (!area) return say_error(area.error());
  const auto airspace =
      read_airspace(arguments.maps, task.value().setting, task.value().has_altitude);
  if (!airspace) return say_error(airspace.error());
  const auto planner = assemble::make_planner("aastar");
  if (!planner) return say_error(planner.error());
  auto aircraft = aircraft_of(arguments, task.value());
  if (!aircraft) return say_error(aircraft.error());
  const exchange::Known known{task.value().setting.frame.has_value(),
                              task.value().has_altitude, aircraft.value().size()};
  if (auto good = check_formats(arguments.output, known); !good)
    return say_error(good.error());
  solve::CoverageQuery query = query_of(arguments, task.value(), area.value());
  query.aircraft = std::move(aircraft).value();
  query.zones = airspace.value().zones;
  query.planner = planner.value().get();
  const bool terminal = isatty(STDERR_FILENO) != 0;
  query.watch.stop = [&stop] { return stop.load(); };
  query.watch.progress = [terminal, reported = -1](double share) mutable {
    const int percent = static_cast<int>(100 * share);
    if (terminal && percent != reported) complain("\r{} % planned", percent);
    reported = percent;
  };
  const solve::CoverageResult found = solve::plan_coverage(query);
  if (terminal) complain("\r              \r");
  const int status =
      put_coverage(arguments, task.value(), area.value(), airspace.value(), found);
  if (!found.stopped) return status;
  complain("note: stopped; this is the best plan so far.\n");
  return kInterrupted;
}

}  // namespace skein::app
