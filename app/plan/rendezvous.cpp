// SPDX-License-Identifier: Apache-2.0
// skein plan rendezvous: several aircraft at their goals at one time, or in a row.
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "app/common/commands.h"
#include "app/common/common.h"
#include "app/plan/conflicts.h"
#include "app/plan/document.h"
#include "app/plan/maps.h"
#include "app/plan/output.h"
#include "app/plan/task.h"
#include "skein/exchange/table/text_shown.h"
#include "skein/solve/target/rendezvous.h"

namespace skein::app {
namespace {

using Json = nlohmann::ordered_json;

Json about_rendezvous(const solve::RendezvousResult& found) {
  Json about = {{"outcome", solve::name_of(found.outcome)}};
  if (!found.reason.empty()) about["reason"] = found.reason;
  if (found.earliest > 0) about["earliest_s"] = found.earliest;
  if (found.plans.empty()) return about;
  about["arrivals_s"] = found.arrivals;
  about["airspeeds_mps"] = found.airspeeds;
  return about;
}

}  // namespace

int plan_rendezvous_command(const PlanRendezvousArguments& arguments) {
  const auto task = read_task(arguments.setting, arguments.limits, arguments.starts,
                              arguments.output, files_of(arguments.maps));
  if (!task) return say_error(task.error());
  const std::vector<FlightState>& starts = task.value().starts;
  const auto goals =
      read_states("to", arguments.to, arguments.to_geo, task.value().setting);
  if (!goals) return say_error(goals.error());
  if (starts.empty() || goals.value().size() != starts.size())
    return say_error(
        {ErrorCode::kBadInput, "--to",
         fmt::format("{} goals for {} starts; one of each for every aircraft "
                     "is needed.",
                     goals.value().size(), starts.size()),
         ""});
  const auto airspace =
      read_airspace(arguments.maps, task.value().setting, task.value().has_altitude);
  if (!airspace) return say_error(airspace.error());
  solve::RendezvousQuery query;
  for (std::size_t i = 0; i < starts.size(); ++i)
    query.aircraft.push_back({starts[i], goals.value()[i].state,
                              arguments.setting.start_time, task.value().limits});
  query.time = arguments.time;
  query.spacing = arguments.spacing;
  query.wind = task.value().setting.air.wind;
  const solve::RendezvousResult found = solve::plan_rendezvous(query);
  Json about = about_rendezvous(found);
  if (found.plans.empty())
    return say_no_plan(std::string(solve::name_of(found.outcome)), found.reason, about,
                       arguments.output, kBadUsage);
  exchange::Document document = document_of("Rendezvous", task.value().setting,
                                            task.value().has_altitude, airspace.value());
  add_flights(document, found.plans);
  for (const ReadState& goal : goals.value())
    document.marks.push_back(
        {exchange::Mark::Kind::kGoal, "", goal.state.p_N, goal.state.heading});
  document.facts = {
      {"First arrival", exchange::shown_clock(*std::min_element(found.arrivals.begin(),
                                                                found.arrivals.end()))}};
  add_facts(document, task.value().setting);
  const bool conflict =
      report_conflicts(found.plans, airspace.value(), task.value(), about);
  const int status = put_plan(document, about, arguments.output);
  return status == kDone && conflict ? static_cast<int>(kFailed) : status;
}

}  // namespace skein::app
