// SPDX-License-Identifier: Apache-2.0
#include "app/plan/document.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "app/common/output.h"
#include "skein/exchange/table/text_shown.h"
#include "skein/model/path/flight_plan.h"

namespace skein::app {

exchange::Document document_of(const std::string& title, const ReadSetting& setting,
                               bool has_altitude, const Airspace& airspace) {
  exchange::Document document;
  document.title = title;
  document.frame = setting.frame;
  document.has_altitude = has_altitude;
  document.zones = airspace.zones;
  document.movers = airspace.movers;
  return document;
}

void add_facts(exchange::Document& document, const ReadSetting& setting) {
  double longest = 0, length = 0;
  for (const exchange::NamedPlan& plan : document.plans) {
    longest = std::max(longest, model::duration(plan.plan));
    length += model::ground_length(plan.plan);
  }
  const bool several = document.plans.size() > 1;
  std::vector<std::pair<std::string, std::string>> facts = {
      {several ? "Longest" : "Time", exchange::shown_time(longest)},
      {several ? "All over ground" : "Over ground", exchange::shown_length(length)},
      {"Airspeed", fmt::format("{:g} m/s", setting.air.airspeed)},
      {"Turn radius", fmt::format("{:g} m", setting.air.turn_radius)}};
  document.facts.insert(document.facts.begin(), facts.begin(), facts.end());
}

void add_flights(exchange::Document& document, const std::vector<FlightPlan>& plans) {
  for (std::size_t i = 0; i < plans.size(); ++i) {
    if (plans[i].empty()) continue;
    const std::string name =
        plans.size() == 1 ? "flight" : fmt::format("aircraft {}", i + 1);
    document.plans.push_back({name, "", plans[i]});
    document.marks.push_back({exchange::Mark::Kind::kStart,
                              plans.size() == 1 ? "start" : fmt::format("{}", i + 1),
                              plans[i].front().p_N, plans[i].front().heading});
  }
}

int say_no_plan(const std::string& outcome, const std::string& reason,
                const nlohmann::ordered_json& about, const PlanOutput& output,
                int status) {
  complain("no plan ({}): {}\n", outcome, reason);
  if (output.json)
    put_out(about.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) +
            "\n");
  return status;
}

}  // namespace skein::app
