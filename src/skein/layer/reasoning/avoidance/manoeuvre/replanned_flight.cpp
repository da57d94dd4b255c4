// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/avoidance/manoeuvre/replanned_flight.h"

#include "skein/model/path/flight_plan.h"
#include "skein/solve/path/repair.h"

namespace skein::reasoning {
namespace {

constexpr std::int64_t kExpansions = 1000;

}  // namespace

std::optional<FlightPlan> replanned(const FlightPlan& plan, double begin, double rejoins,
                                    PathQuery query, const Airspace& airspace) {
  const FlightPlan old = solve::part_of(plan, begin, rejoins);
  if (old.empty()) return std::nullopt;
  const model::FlightMoment from = model::moment_at(old, begin);
  const model::FlightMoment to = model::end_of(old.back());
  query.start = {from.p_N, from.heading};
  query.goal = {to.p_N, to.heading};
  query.start_time = begin;
  query.wind = old.front().wind;
  query.airspace = &airspace;
  query.budget.expansions = kExpansions;
  solve::RepairedPath repaired = solve::repair(old, query);
  if (repaired.how == solve::Repair::kFailed || repaired.how == solve::Repair::kKept ||
      repaired.path.plan.empty())
    return std::nullopt;
  append_rest(repaired.path.plan, plan, rejoins);
  return std::move(repaired.path.plan);
}

void append_rest(FlightPlan& flight, const FlightPlan& plan, double rejoins) {
  const double end = model::end_time_of(plan);
  if (!flight.empty() && rejoins < end)
    model::append(flight, solve::part_of(plan, rejoins, end));
}

}  // namespace skein::reasoning
