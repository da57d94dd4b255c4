// SPDX-License-Identifier: Apache-2.0
// skein plan fleet: many aircraft that keep out of each other's rooms.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "app/common/commands.h"
#include "app/common/common.h"
#include "app/common/output.h"
#include "app/plan/document.h"
#include "app/plan/input.h"
#include "app/plan/maps.h"
#include "app/plan/output.h"
#include "app/plan/separation/separation.h"
#include "skein/exchange/plan/fleet_table.h"
#include "skein/exchange/table/text_shown.h"
#include "skein/model/path/flight_plan.h"
#include "skein/solve/path/fleet_plan.h"
#include "skein/solve/path/link.h"

namespace skein::app {
namespace {

using Json = nlohmann::ordered_json;
using exchange::FleetRow;
using exchange::FleetTable;

// What is known of one aircraft's flight; without a flight only why.
struct FleetFlight {
  const FleetRow* row = nullptr;
  const PlannedPath* path = nullptr;
  double start = 0, delay = 0;  // [s]
  double time = 0, length = 0;  // of the flight, over ground [s], [m]
  double direct_length = 0;     // of the flight that it would take alone [m]
  bool flies() const { return !path->plan.empty(); }
  double extra_length() const { return length - direct_length; }
};

// Of all that fly.
struct FleetTotals {
  std::size_t planned = 0, delayed = 0;
  double longest_delay = 0, delays = 0;  // [s]
  double length = 0, direct_length = 0;  // [m]
  double extra_share() const {
    return direct_length > 0 ? length / direct_length - 1 : 0;
  }
};

solve::FleetQuery fleet_query(const PlanFleetArguments& arguments,
                              const ReadSetting& setting, const FlightLimits& limits,
                              const FleetTable& table, const Airspace& airspace,
                              const std::atomic<bool>& stop) {
  solve::FleetQuery query;
  query.common.wind = setting.air.wind;
  query.common.airspace = &airspace;
  query.common.budget.expansions = arguments.expansions;
  query.common.budget.stop = [&stop] { return stop.load(); };
  query.zone = {arguments.ahead, arguments.behind, arguments.radius};
  query.height = arguments.height;
  for (const FleetRow& row : table.rows) {
    const EntityId who{static_cast<std::uint32_t>(query.members.size() + 1)};
    query.members.push_back(
        {who, row.start, row.goal, row.earliest_start, row.latest_start, limits});
  }
  return query;
}

// Over ground, of the quickest flight among no others and no obstacles.
double direct_length(const solve::FleetQuery& query, const FleetRow& row,
                     const FlightLimits& limits) {
  PathQuery alone = query.common;
  alone.start = row.start;
  alone.goal = row.goal;
  alone.limits = limits;
  const solve::Link link = solve::link(row.start, row.goal, alone);
  if (!std::isfinite(link.duration)) return 0;
  return model::ground_length(
      solve::to_flight_plan(link, row.start, row.earliest_start, alone));
}

std::vector<FleetFlight> flights_of(const FleetTable& table,
                                    const solve::FleetQuery& query,
                                    const solve::FleetPlan& plan,
                                    const FlightLimits& limits) {
  std::vector<FleetFlight> flights;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    FleetFlight flight{&table.rows[i], &plan.paths[i], 0, 0, 0, 0, 0};
    if (flight.flies()) {
      flight.start = model::start_of(flight.path->plan);
      flight.delay = flight.start - flight.row->earliest_start;
      flight.time = model::duration(flight.path->plan);
      flight.length = model::ground_length(flight.path->plan);
      flight.direct_length = direct_length(query, *flight.row, limits);
    }
    flights.push_back(flight);
  }
  return flights;
}

FleetTotals totals_of(const std::vector<FleetFlight>& flights) {
  FleetTotals totals;
  for (const FleetFlight& flight : flights) {
    if (!flight.flies()) continue;
    ++totals.planned;
    totals.delayed += flight.delay > 0 ? 1U : 0U;
    totals.delays += flight.delay;
    totals.longest_delay = std::max(totals.longest_delay, flight.delay);
    totals.length += flight.length;
    totals.direct_length += flight.direct_length;
  }
  return totals;
}

Json pair_json(const separation::NearestPair& pair, const FleetTable& table) {
  return {{"aircraft", {table.rows[pair.a].name, table.rows[pair.b].name}},
          {"time_s", pair.time},
          {"distance_m", pair.distance}};
}

Json separation_json(const separation::Separation& found, const FleetTable& table) {
  Json about = {{"pairs", found.pairs}, {"pairs_in_rooms", found.pairs_in_rooms}};
  if (found.nearest) about["nearest"] = pair_json(*found.nearest, table);
  if (found.nearest_room) about["nearest_room"] = pair_json(*found.nearest_room, table);
  return about;
}

Json about_fleet(const std::vector<FleetFlight>& flights, const FleetTotals& totals) {
  Json about = {{"aircraft", flights.size()}, {"planned", totals.planned},
                {"delayed", totals.delayed},  {"longest_delay_s", totals.longest_delay},
                {"length_m", totals.length},  {"direct_length_m", totals.direct_length}};
  about["flights"] = Json::array();
  for (const FleetFlight& flight : flights) {
    Json one = {{"name", flight.row->name},
                {"outcome", name_of(flight.path->outcome)},
                {"expansions", flight.path->expansions}};
    if (!flight.path->reason.empty()) one["reason"] = flight.path->reason;
    if (flight.flies()) {
      one["start_s"] = flight.start;
      one["delay_s"] = flight.delay;
      one["time_s"] = flight.time;
      one["length_m"] = flight.length;
      one["direct_length_m"] = flight.direct_length;
    }
    about["flights"].push_back(std::move(one));
  }
  return about;
}

std::string shown_pair(const separation::NearestPair& pair, const FleetTable& table) {
  return fmt::format("{} m: {} and {} at {}", exchange::shown_tenths(pair.distance),
                     table.rows[pair.a].name, table.rows[pair.b].name,
                     exchange::shown_clock(pair.time));
}

std::vector<std::pair<std::string, std::string>> facts_of(
    const FleetTotals& totals, const separation::Separation& found,
    const FleetTable& table) {
  std::vector<std::pair<std::string, std::string>> facts = {
      {"Planned", fmt::format("{} of {} aircraft", totals.planned, table.rows.size())}};
  if (totals.planned == 0) return facts;
  facts.emplace_back(
      "Delayed",
      totals.delayed == 0
          ? "none"
          : fmt::format("{}, by {} at most, {} in the mean of all", totals.delayed,
                        exchange::shown_time(totals.longest_delay),
                        exchange::shown_time(totals.delays /
                                             static_cast<double>(totals.planned))));
  facts.emplace_back(
      "Longer than alone",
      fmt::format("by {} m, {} %",
                  exchange::shown_tenths(totals.length - totals.direct_length),
                  exchange::shown_tenths(100 * totals.extra_share())));
  if (found.nearest)
    facts.emplace_back("Least separation", shown_pair(*found.nearest, table));
  if (found.nearest_room)
    facts.emplace_back("Least within rooms' time and height",
                       shown_pair(*found.nearest_room, table));
  return facts;
}

void print_fleet(const exchange::Document& document,
                 const std::vector<FleetFlight>& flights) {
  print("{}\n", document.title);
  for (const auto& [name, value] : document.facts) print("  {}: {}\n", name, value);
  std::size_t width = 4;
  for (const FleetFlight& flight : flights)
    width = std::max(width, std::min<std::size_t>(flight.row->name.size(), 40));
  print("\n   #  {:<{}}   start s   delay s    time s  length m   extra m\n", "name",
        width);
  for (std::size_t i = 0; i < flights.size(); ++i) {
    const FleetFlight& flight = flights[i];
    if (flight.flies())
      print("{:>4}  {:<{}} {:>9.2f} {:>9.2f} {:>9.2f} {:>9.1f} {:>9}\n", i + 1,
            flight.row->name, width, flight.start, flight.delay, flight.time,
            flight.length, exchange::shown_tenths(flight.extra_length()));
    else
      print("{:>4}  {:<{}}   {}\n", i + 1, flight.row->name, width,
            name_of(flight.path->outcome));
  }
}

exchange::Document fleet_document(const std::vector<FleetFlight>& flights,
                                  const FleetTable& table, const ReadSetting& setting,
                                  const Airspace& airspace) {
  exchange::Document document =
      document_of("Fleet", setting, table.has_altitude, airspace);
  for (const FleetFlight& flight : flights) {
    if (!flight.flies()) continue;
    const FleetRow& row = *flight.row;
    document.plans.push_back({row.name, "", flight.path->plan});
    document.marks.push_back(
        {exchange::Mark::Kind::kStart, row.name, row.start.p_N, row.start.heading});
    document.marks.push_back(
        {exchange::Mark::Kind::kGoal, "", row.goal.p_N, row.goal.heading});
  }
  return document;
}

int plan_fleet_table(const PlanFleetArguments& arguments, const std::atomic<bool>& stop,
                     const ReadSetting& setting, const FleetTable& table) {
  const auto limits = limits_of(arguments.limits, setting);
  if (!limits) return say_error(limits.error());
  const auto airspace = read_airspace(arguments.maps, setting, table.has_altitude);
  if (!airspace) return say_error(airspace.error());
  const solve::FleetQuery query =
      fleet_query(arguments, setting, limits.value(), table, airspace.value(), stop);
  const solve::FleetPlan plan = solve::plan_fleet(query);
  if (stop) return kInterrupted;
  const auto flights = flights_of(table, query, plan, limits.value());
  std::vector<FlightPlan> paths;
  for (const PlannedPath& path : plan.paths) paths.push_back(path.plan);
  separation::SeparationOptions options;
  options.zone = query.zone;
  options.height = query.height;
  options.stop = query.common.budget.stop;
  const separation::Separation found = separation::separation_of(paths, options);
  if (stop) return kInterrupted;
  const FleetTotals totals = totals_of(flights);
  for (const FleetFlight& flight : flights)
    if (!flight.flies())
      complain("note: {} has no flight ({}): {}\n", flight.row->name,
               name_of(flight.path->outcome), flight.path->reason);
  if (found.pairs_in_rooms > 0)
    complain("note: {} pairs of flights come into each other's rooms.\n",
             found.pairs_in_rooms);
  Json about = about_fleet(flights, totals);
  about["separation"] = separation_json(found, table);
  exchange::Document document = fleet_document(flights, table, setting, airspace.value());
  document.facts = facts_of(totals, found, table);
  add_facts(document, setting);
  if (auto good = write_plan_files(document, arguments.output); !good)
    return say_error(good.error());
  if (arguments.output.json)
    print_plan_json(document, about);
  else
    print_fleet(document, flights);
  const bool all = totals.planned == flights.size() && found.pairs_in_rooms == 0;
  return all ? kDone : kFailed;
}

}  // namespace

int plan_fleet_command(const PlanFleetArguments& arguments,
                       const std::atomic<bool>& stop) {
  const auto inputs = files_of(arguments.maps, arguments.cases);
  if (auto good = check_files(arguments.output, inputs); !good)
    return say_error(good.error());
  const auto setting = read_setting(arguments.setting, std::nullopt);
  if (!setting) return say_error(setting.error());
  std::string text;
  if (auto good = read_text(arguments.cases, text); !good) return say_error(good.error());
  exchange::FleetDefaults defaults;
  defaults.frame = setting.value().frame ? &*setting.value().frame : nullptr;
  defaults.altitude = arguments.setting.altitude;
  defaults.earliest_start = arguments.setting.start_time;
  defaults.latest_start = arguments.latest_start;
  const auto table = exchange::read_fleet_table(text, arguments.cases, defaults);
  if (!table) return say_error(table.error());
  if (!table.value().has_altitude)
    return say_error({ErrorCode::kBadInput, "--altitude-m",
                      "is needed: rooms have a height, and flights keep apart by it too.",
                      "Give it, or start_altitude_m and goal_altitude_m."});
  const exchange::Known known{setting.value().frame.has_value(),
                              table.value().has_altitude, table.value().rows.size()};
  if (auto good = check_formats(arguments.output, known); !good)
    return say_error(good.error());
  return plan_fleet_table(arguments, stop, setting.value(), table.value());
}

}  // namespace skein::app
