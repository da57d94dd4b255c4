// SPDX-License-Identifier: Apache-2.0
// skein plan path: around zones, terrain and moving obstacles.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "app/common/commands.h"
#include "app/common/common.h"
#include "app/common/output.h"
#include "app/plan/document.h"
#include "app/plan/input.h"
#include "app/plan/maps.h"
#include "app/plan/output.h"
#include "skein/assemble/kinds/kinds_of.h"
#include "skein/assemble/kinds/planner_kinds.h"
#include "skein/exchange/table/text_shown.h"
#include "skein/layer/environment/terrain/raster_terrain.h"

namespace skein::app {
namespace {

using Json = nlohmann::ordered_json;
using Made = Result<std::unique_ptr<Terrain>>;

// Half the side of the square about the origin in which the ground is known [m].
double extent_of(const ReadEnds& ends) {
  constexpr double kRoom = 2000;  // around start and goal [m]
  const auto far = [](const FlightState& s) {
    return s.p_N.head<2>().cwiseAbs().maxCoeff();
  };
  return std::max(far(ends.from), far(ends.to)) + kRoom;
}

Made make_terrain(const std::string& file, const ReadSetting& setting, double extent) {
  if (!setting.frame)
    return Error{ErrorCode::kBadInput, "--terrain", "needs a place on Earth.",
                 "Give --origin."};
  environment::RasterTerrainOptions options;
  options.file = file;
  options.area = extent;
  auto made = assemble::terrain_kinds().make(
      {"raster", options}, assemble::EnvironmentContext{*setting.frame, {}});
  if (made || made.error().hint.empty()) return made;
  // The raster's own hints name options of scenarios.
  Error error = made.error();
  error.hint = fmt::format(
      "Needed is the square about the origin, {:.0f} m to each side, that --from and "
      "--to "
      "lie in with 2000 m to spare: give a larger raster, nearer ends or another "
      "--origin.",
      extent);
  return error;
}

// What lies below the floor and above the ceiling, as zones over all of the map.
void add_band(const PlanPathArguments& arguments, double extent, Airspace& airspace) {
  const double far = 10 * extent;
  constexpr double kRim = 1e-3;  // at the limit is within, although zones hold their rim
  const geo::Ring everywhere = {{far, far}, {-far, far}, {-far, -far}, {far, -far}};
  Zone zone;
  zone.area = everywhere;
  if (arguments.floor) {
    zone.name = "below --floor-m";
    zone.ceiling_msl = *arguments.floor - kRim;
    airspace.zones.push_back(zone);
  }
  zone = Zone{everywhere};
  if (arguments.ceiling) {
    zone.name = "above --ceiling-m";
    zone.floor_msl = *arguments.ceiling + kRim;
    airspace.zones.push_back(zone);
  }
}

PlanningBudget budget_of(const PlanPathArguments& arguments,
                         const std::atomic<bool>& stop) {
  PlanningBudget budget;
  budget.first = arguments.first;
  if (arguments.time_limit)
    budget.expansions = std::numeric_limits<std::int64_t>::max();  // the time decides
  if (arguments.expansions) budget.expansions = *arguments.expansions;
  using Clock = std::chrono::steady_clock;
  const auto begin = Clock::now();
  const double limit = arguments.time_limit.value_or(1e9);
  budget.stop = [&stop] { return stop.load(); };
  budget.enough = [begin, limit] {
    return std::chrono::duration<double>(Clock::now() - begin).count() > limit;
  };
  return budget;
}

Json about_path(const PlannedPath& path, double seconds) {
  Json about = {{"outcome", name_of(path.outcome)}};
  if (!path.reason.empty()) about["reason"] = path.reason;
  if (!path.plan.empty() || path.outcome == PlanningOutcome::kFound) {
    about["time_s"] = path.duration;
    about["bound_s"] = path.bound;
  }
  about["expansions"] = path.expansions;
  about["planning_s"] = seconds;
  if (path.alternative)
    about["alternative"] = {{"north_m", path.alternative->p_N.x()},
                            {"east_m", path.alternative->p_N.y()},
                            {"altitude_m", 0.0 - path.alternative->p_N.z()}};
  return about;
}

int status_of(PlanningOutcome outcome) {
  switch (outcome) {
    case PlanningOutcome::kFound:
    case PlanningOutcome::kBudgetEnded:
      return kDone;
    case PlanningOutcome::kNoPath:
    case PlanningOutcome::kNothingFound:
      return kFailed;
    default:
      return kBadUsage;
  }
}

// That a blocked end is above the ceiling or below the floor, and by how much; empty when
// it is not. (To the planner these are zones that have sides, too.)
std::string out_of_band(const PlanPathArguments& arguments, const ReadEnds& ends,
                        PlanningOutcome outcome) {
  const bool start = outcome == PlanningOutcome::kStartBlocked;
  if (!start && outcome != PlanningOutcome::kGoalBlocked) return {};
  const double altitude = 0.0 - (start ? ends.from : ends.to).p_N.z();
  const auto said = [&](const char* where, double limit) {
    return fmt::format("the {} at {} m is {}, {:g} m, by {} m", start ? "start" : "goal",
                       exchange::shown_tenths(altitude), where, limit,
                       exchange::shown_tenths(std::abs(altitude - limit)));
  };
  if (arguments.ceiling && altitude > *arguments.ceiling)
    return said("above --ceiling-m", *arguments.ceiling);
  if (arguments.floor && altitude < *arguments.floor)
    return said("below --floor-m", *arguments.floor);
  return {};
}

std::string reason_of(const PlanPathArguments& arguments, const ReadEnds& ends,
                      const PlannedPath& path) {
  std::string reason = out_of_band(arguments, ends, path.outcome);
  // The planner may have named the alternative, with all its digits.
  if (reason.empty()) reason = path.reason.substr(0, path.reason.find("; the nearest"));
  if (!path.alternative) return reason;
  const Vec3& p = path.alternative->p_N;
  return fmt::format("{}. The nearest free place: {} m north, {} m east, at {} m.",
                     reason, exchange::shown_tenths(p.x()), exchange::shown_tenths(p.y()),
                     exchange::shown_tenths(-p.z()));
}

Result<PathQuery> query_of(const PlanPathArguments& arguments, const ReadSetting& setting,
                           const ReadEnds& ends) {
  const auto limits = limits_of(arguments.limits, setting);
  if (!limits) return limits.error();
  const bool needs_altitude =
      !arguments.terrain.empty() || arguments.floor || arguments.ceiling;
  if (needs_altitude && !ends.has_altitude)
    return Error{ErrorCode::kBadInput, "--altitude-m",
                 "is needed with --terrain, --floor-m and --ceiling-m.", ""};
  PathQuery query;
  query.start = ends.from;
  query.goal = ends.to;
  query.start_time = arguments.setting.start_time;
  query.limits = limits.value();
  query.wind = setting.air.wind;
  query.ground_clearance = arguments.clearance;
  return query;
}

int plan_path(const PlanPathArguments& arguments, const std::atomic<bool>& stop,
              const ReadSetting& setting, const ReadEnds& ends) {
  auto query = query_of(arguments, setting, ends);
  if (!query) return say_error(query.error());
  auto airspace = read_airspace(arguments.maps, setting, ends.has_altitude);
  if (!airspace) return say_error(airspace.error());
  const Airspace shown = airspace.value();
  add_band(arguments, extent_of(ends), airspace.value());
  query.value().airspace = &airspace.value();
  std::unique_ptr<Terrain> terrain;
  if (!arguments.terrain.empty()) {
    const double extent = extent_of(ends);
    auto made = make_terrain(arguments.terrain, setting, extent);
    if (!made) return say_error(made.error());
    terrain = std::move(made).value();
    query.value().terrain = terrain.get();
    query.value().south_west = Vec2::Constant(-extent);
    query.value().north_east = Vec2::Constant(extent);
  }
  const auto planner = assemble::make_planner(arguments.planner);
  if (!planner) return say_error(planner.error());
  query.value().budget = budget_of(arguments, stop);
  const auto begin = std::chrono::steady_clock::now();
  PlannedPath path = planner.value()->plan(query.value());
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  path.reason = reason_of(arguments, ends, path);
  const Json about = about_path(path, took.count());
  // A path without elements is one where the start is the goal.
  const bool found = !path.plan.empty() || path.outcome == PlanningOutcome::kFound;
  if (stop && !found) return kInterrupted;
  if (!found)
    return say_no_plan(std::string(name_of(path.outcome)), path.reason, about,
                       arguments.output, status_of(path.outcome));
  if (path.plan.empty()) complain("note: {}; the plan is empty.\n", path.reason);
  exchange::Document document =
      document_of("Path around obstacles", setting, ends.has_altitude, shown);
  add_flights(document, {path.plan});
  if (path.plan.empty()) document.plans.push_back({"flight", "", {}});
  document.marks.push_back(
      {exchange::Mark::Kind::kGoal, "goal", ends.to.p_N, ends.to.heading});
  document.facts = {{"Outcome", std::string(name_of(path.outcome))},
                    {"No path is below", exchange::shown_time_below(path.bound)}};
  add_facts(document, setting);
  const int status = put_plan(document, about, arguments.output);
  return stop ? static_cast<int>(kInterrupted) : status;
}

}  // namespace

int plan_path_command(const PlanPathArguments& arguments, const std::atomic<bool>& stop) {
  const auto inputs = files_of(arguments.maps, arguments.terrain);
  if (auto good = check_files(arguments.output, inputs); !good)
    return say_error(good.error());
  const auto place = place_of(arguments.ends.from_geo);
  if (!place) return say_error(place.error());
  const auto setting = read_setting(arguments.setting, place.value());
  if (!setting) return say_error(setting.error());
  const auto ends = read_ends(arguments.ends, setting.value());
  if (!ends) return say_error(ends.error());
  const bool place_known = setting.value().frame.has_value();
  if (auto good =
          check_formats(arguments.output, {place_known, ends.value().has_altitude});
      !good)
    return say_error(good.error());
  return plan_path(arguments, stop, setting.value(), ends.value());
}

}  // namespace skein::app
