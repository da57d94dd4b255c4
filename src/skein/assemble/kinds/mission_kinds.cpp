// SPDX-License-Identifier: Apache-2.0
// What an operator may want of aircraft: one row each.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "skein/assemble/kinds/kind_registry.h"
#include "skein/assemble/kinds/mission_fields.h"
#include "skein/assemble/kinds/mission_kinds.h"
#include "skein/assemble/kinds/ranges.h"
#include "skein/layer/reasoning/mission/formation/formation_control.h"
#include "skein/layer/reasoning/perimeter/coordinator/coordinator.h"
#include "skein/layer/reasoning/trajectory/round_trip.h"

namespace skein::assemble {
namespace {

using reasoning::PlannedMission;
using scenario::Choice;
using scenario::Fields;
using MadeMission = Result<std::unique_ptr<PlannedMission>>;

constexpr scenario::Range kLength{.above = 0, .at_most = 1e6};
constexpr scenario::Range kBearing{.at_least = -360, .at_most = 360};

Fields<PerimeterPrior> prior_fields() {
  using T = PerimeterPrior;
  return Fields<T>()
      .point("origin_m", &T::origin, "Believed origin of the fire.")
      .number("radius_m", &T::radius, "Believed distance of the perimeter at the start.",
              kLength)
      .number("radius_sd_m", &T::radius_sd, "Its standard deviation.", kLength)
      .number("rate_mps", &T::rate, "Believed rate of spread.",
              {.at_least = 0, .at_most = 100})
      .number("rate_sd_mps", &T::rate_sd, "Its standard deviation.",
              {.at_least = 0, .at_most = 100})
      .vector("wind_mps", &T::wind,
              "Believed drift of the perimeter, towards where it moves.",
              {.at_least = -100, .at_most = 100})
      .number("wind_sd_mps", &T::wind_sd,
              "Standard deviation of the drift that is not known, per axis.",
              {.at_least = 0, .at_most = 100});
}

// From the start until an aircraft first crosses the perimeter.
struct Deployment {
  std::vector<double> courses;  // of the transects [rad]; empty: to the fire's origin
  bool all_sides = false;
  Time limit = Time::from_seconds(600);
};

Fields<Deployment> deployment_fields() {
  using T = Deployment;
  return Fields<T>()
      .angle_deg("courses_deg", &T::courses,
                 "Courses of the transects, one for each aircraft, repeated when there "
                 "are fewer. Empty: each flies to the believed origin.",
                 kBearing)
      .items({.at_most = 10000})
      .boolean("all_sides", &T::all_sides,
               "The station first plans an entry for each aircraft, outside of where the "
               "perimeter is believed to be, on evenly spaced sides: so the perimeter is "
               "met from all sides although they start from one place.")
      .rule("all_sides",
            [](const T& t) {
              return t.all_sides && !t.courses.empty()
                         ? std::string("has no use for courses_deg; give one of the two.")
                         : std::string();
            })
      .duration_s("limit_s", &T::limit, "A transect without a crossing ends after this.",
                  {.above = 0});
}

struct Outlook {
  std::vector<double> horizons = {600, 1800, 3600};  // [s]
  Time period = Time::from_seconds(600);
  std::vector<perimeter::ArrivalPlace> places;
};

Fields<perimeter::ArrivalPlace> arrival_place_fields() {
  using T = perimeter::ArrivalPlace;
  return Fields<T>()
      .text("name", &T::name, "What it is called.")
      .required()
      .point("position_m", &T::point, "Where it is.")
      .required();
}

Fields<Outlook> outlook_fields() {
  using T = Outlook;
  return Fields<T>()
      .number(
          "horizons_s", &T::horizons,
          "So far ahead the perimeter is forecast, in growing order. Empty: it is not.",
          {.above = 0, .at_most = 1e6})
      .items({.at_most = 20})
      .duration_s("period_s", &T::period, "Between two forecasts.", {.at_least = 1})
      .object("places", &T::places, arrival_place_fields(),
              "Places for which it is forecast when the fire comes, by the last horizon.")
      .items({.at_most = 1000})
      .rule("horizons_s", [](const T& t) {
        return std::adjacent_find(t.horizons.begin(), t.horizons.end(),
                                  std::greater_equal<>()) == t.horizons.end()
                   ? std::string()
                   : std::string("must grow from one to the next.");
      });
}

struct PerimeterChoice : MissionSchedule {
  Choice estimator{"adaptive"};
  Choice strategy{"sweep"};
  PerimeterPrior prior;
  Deployment deployment;
  Time forced_crossing = Time::from_seconds(300);  // 0 = off
  Time lost_after = Time::from_seconds(5);
  Time late_window = Time::from_seconds(60);
  int phenomenon = 0;
  Outlook forecast;
};

Fields<PerimeterChoice> perimeter_fields() {
  using T = PerimeterChoice;
  return with_schedule(
      Fields<T>()
          .kind("estimator", &T::estimator, "estimator", "What keeps the belief.")
          .kind("strategy", &T::strategy, "strategy", "What sends the aircraft.")
          .object("prior", &T::prior, prior_fields(),
                  "What is known before the first reading.")
          .object("deployment", &T::deployment, deployment_fields(),
                  "Until the first crossing.")
          .duration_s("forced_crossing_s", &T::forced_crossing,
                      "An aircraft without a crossing for this long is sent to cross. 0: "
                      "never.",
                      {.at_least = 0})
          .duration_s("lost_after_s", &T::lost_after,
                      "An aircraft silent for this long counts as lost.", {.above = 0})
          .duration_s("late_window_s", &T::late_window, "Readings this late still count.",
                      {.at_least = 0})
          .object("forecast", &T::forecast, outlook_fields(),
                  "What is believed of the times ahead, from the first allocation on.")
          .integer("phenomenon", &T::phenomenon,
                   "Which of environment.phenomena it is about, from 0: its belief is "
                   "compared with that one.",
                   {.at_least = 0, .at_most = 1000}));
}

MadeMission make_perimeter(const PerimeterChoice& choice, const MissionContext& c) {
  auto who = team_of(choice, c);
  if (!who) return who.error();
  auto estimator = c.kinds.estimator.make(choice.estimator, {c.seed, choice.prior});
  if (!estimator) return estimator.error();
  auto strategy = c.kinds.strategy.make(choice.strategy, {});
  if (!strategy) return strategy.error();

  perimeter::CoordinatorOptions options;
  options.team = who.value().candidates;
  options.origin = choice.prior.origin;
  options.entry_courses = choice.deployment.courses;
  options.all_sides = choice.deployment.all_sides;
  options.forced_crossing = choice.forced_crossing.seconds();
  options.deployment_limit = choice.deployment.limit.seconds();
  options.lost_after = choice.lost_after.seconds();
  options.late_window = choice.late_window.seconds();
  options.zones = c.zones;
  options.phenomenon = static_cast<std::uint32_t>(choice.phenomenon);
  // The first may be missing: then nothing burns, and that is what it finds.
  if (options.phenomenon > 0)
    if (auto good = check_phenomenon(options.phenomenon, c.phenomena); !good)
      return good.error();
  options.forecast = {choice.forecast.horizons, choice.forecast.period,
                      choice.forecast.places};
  options.record_period = c.metrics_period;
  return planned("perimeter", choice, who.value(),
                 std::make_unique<perimeter::Coordinator>(
                     options, std::move(estimator).value(), std::move(strategy).value()));
}

struct LeaderChange {
  Time at;
  int aircraft = 0;
};

struct FormationChoice : MissionSchedule {
  std::vector<Vec2> route = {{0, 0}, {1000, 0}, {1000, 1000}, {0, 1000}};
  int laps = 1000;
  std::vector<Vec2> slots = {{-40, 40}, {-40, -40}, {-80, 80}, {-80, -80}};
  std::vector<LeaderChange> leaders = {LeaderChange{}};
  bool direct = false;
  double leader_timeout = reasoning::FormationOptions{}.leader_timeout;
};

Fields<LeaderChange> leader_fields() {
  using T = LeaderChange;
  return Fields<T>()
      .duration_s("at_s", &T::at, "From when on.")
      .integer("aircraft", &T::aircraft,
               "Which aircraft leads, counted over all of the mission.",
               {.at_least = 0, .at_most = 100000});
}

Fields<FormationChoice> formation_fields() {
  using T = FormationChoice;
  return with_schedule(
      Fields<T>()
          .point("route_m", &T::route, "Corners of the leader's route.")
          .items({.at_least = 1, .at_most = 10000})
          .integer("laps", &T::laps, "Laps of the route.",
                   {.at_least = 1, .at_most = 1000000})
          .vector("slots_m", &T::slots,
                  "Places of the followers: ahead of the leader, to its right.")
          .items({.at_most = 10000})
          .object("leaders", &T::leaders, leader_fields(), "Who leads, in order of time.")
          .items({.at_least = 1, .at_most = 10000})
          .boolean(
              "direct", &T::direct,
              "The leader reports its position to its followers itself; else the station "
              "passes it on.")
          .duration_s("leader_timeout_s", &T::leader_timeout,
                      "A leader that is not counted on for so long (unheard for 5 s, or "
                      "under another command) is replaced by the first aircraft that is; "
                      "that begins the route anew.",
                      {.at_least = 5})
          .rule("leaders", [](const T& t) {
            for (std::size_t k = 1; k < t.leaders.size(); ++k)
              if (t.leaders[k].at <= t.leaders[k - 1].at)
                return std::string("at_s must grow from one to the next.");
            return t.leaders.front().at == Time()
                       ? std::string()
                       : std::string("the first must be at 0 s.");
          }));
}

MadeMission make_formation(const FormationChoice& choice, const MissionContext& c) {
  const auto refuse = [](std::string message, std::string hint) {
    return Error{ErrorCode::kBadInput, "", std::move(message), std::move(hint)};
  };
  auto who = team_of(choice, c);
  if (!who) return who.error();
  const std::vector<EntityId>& team = who.value().candidates;
  if (team.empty()) return refuse("a formation needs aircraft.", "Add a group.");
  if (choice.slots.size() + 1 < team.size())
    return refuse(fmt::format("slots_m has {} places for {} followers.",
                              choice.slots.size(), team.size() - 1),
                  "Give one for each aircraft but the leader.");
  // Others the leader flies around, when and where they forbid its flight.
  std::vector<Zone> zones = c.zones;
  std::erase_if(zones, [](const Zone& zone) {
    return zone.from > 0 || std::isfinite(zone.until) || std::isfinite(zone.floor_msl) ||
           std::isfinite(zone.ceiling_msl);
  });
  if (const auto at = reasoning::into_zone(choice.route, choice.laps > 1, zones))
    return refuse(fmt::format("route_m leads into a no-fly zone at {:.0f} m north, "
                              "{:.0f} m east.",
                              at->x(), at->y()),
                  "Lead it around the zone.");
  reasoning::FormationOptions options;
  options.team = team;
  options.route = choice.route;
  options.laps = choice.laps;
  options.slots = choice.slots;
  options.direct = choice.direct;
  options.leader_timeout = choice.leader_timeout;
  for (const LeaderChange& change : choice.leaders) {
    const auto leader = static_cast<std::size_t>(change.aircraft);
    if (leader >= team.size())
      return refuse(fmt::format("aircraft {} cannot lead: there are {}, counted from 0.",
                                leader, team.size()),
                    "");
    options.leaders.push_back({change.at, leader});
  }
  return planned("formation", choice, who.value(),
                 std::make_unique<reasoning::FormationControl>(options));
}

}  // namespace

Kinds<PlannedMission, MissionContext> mission_kinds() {
  Kinds<PlannedMission, MissionContext> kinds("mission");
  kinds.add("perimeter", "Keeps a fire's perimeter known.", perimeter_fields(),
            [](const PerimeterChoice& choice, const MissionContext& c) {
              return make_perimeter(choice, c);
            });
  kinds.add("formation", "Leader and followers along a route.", formation_fields(),
            [](const FormationChoice& choice, const MissionContext& c) {
              return make_formation(choice, c);
            });
  add_team_missions(kinds);
  return kinds;
}

}  // namespace skein::assemble
