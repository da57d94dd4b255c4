// What reasons on the ground: one row each.

#include <fmt/format.h>

#include <cmath>

#include "skein/assemble/kind_registry.h"
#include "skein/layer/reasoning/agent/listener.h"
#include "skein/layer/reasoning/trajectory/round_trip.h"
#include "skein/layer/reasoning/monitoring/coordinator/coordinator.h"
#include "skein/layer/reasoning/team/formation_control.h"
#include "skein/scenario/scenario.h"

namespace skein::assemble {
namespace {

using scenario::Fields;

struct ListenerChoice {};
struct CoordinatorChoice {};  // its options are the scenario's `monitoring`

Result<std::unique_ptr<Agent>> make_coordinator(const StationContext& c) {
  const scenario::Monitoring& mission = c.scenario.monitoring;
  auto estimator =
      c.kinds.estimator.make(mission.estimator, {c.scenario.seed, mission.prior});
  if (!estimator) return estimator.error();
  auto strategy = c.kinds.strategy.make(mission.strategy, {});
  if (!strategy) return strategy.error();

  monitoring::CoordinatorOptions options;
  options.team = c.team;
  options.origin = mission.prior.origin;
  options.entry_courses = mission.deployment.courses;
  options.forced_crossing = mission.forced_crossing.seconds();
  options.deployment_limit = mission.deployment.limit.seconds();
  options.lost_after = mission.lost_after.seconds();
  options.late_window = mission.late_window.seconds();
  options.zones = c.zones;
  options.record_period = c.scenario.record.metrics_period;
  return std::unique_ptr<Agent>(std::make_unique<monitoring::Coordinator>(
      options, std::move(estimator).value(), std::move(strategy).value()));
}

struct LeaderChange {
  Time at;
  int aircraft = 0;
};

struct FormationChoice {
  std::vector<Vec2> route = {{0, 0}, {1000, 0}, {1000, 1000}, {0, 1000}};
  int laps = 1000;
  std::vector<Vec2> slots = {{-40, 40}, {-40, -40}, {-80, 80}, {-80, -80}};
  std::vector<LeaderChange> leaders = {LeaderChange{}};
  bool direct = false;
};

Fields<LeaderChange> leader_fields() {
  using T = LeaderChange;
  return Fields<T>()
      .duration_s("at_s", &T::at, "From when on.")
      .integer("aircraft", &T::aircraft, "Which aircraft leads, counted over all groups.",
               {.at_least = 0, .at_most = 100000});
}

Fields<FormationChoice> formation_fields() {
  using T = FormationChoice;
  return Fields<T>()
      .point("route_m", &T::route, "Corners of the leader's route.")
      .items({.at_least = 1, .at_most = 10000})
      .integer("laps", &T::laps, "Laps of the route.",
               {.at_least = 1, .at_most = 1000000})
      .point("slots_m", &T::slots,
             "Places of the followers: ahead of the leader, to its right.")
      .items({.at_most = 10000})
      .object("leaders", &T::leaders, leader_fields(), "Who leads, in order of time.")
      .items({.at_least = 1, .at_most = 10000})
      .boolean(
          "direct", &T::direct,
          "The leader reports its position to its followers itself; else the station "
          "passes it on.")
      .rule("leaders", [](const T& t) {
        for (std::size_t k = 1; k < t.leaders.size(); ++k)
          if (t.leaders[k].at <= t.leaders[k - 1].at)
            return std::string("at_s must grow from one to the next.");
        return t.leaders.front().at == Time() ? std::string()
                                              : std::string("the first must be at 0 s.");
      });
}

Result<std::unique_ptr<Agent>> make_formation(const FormationChoice& choice,
                                              const StationContext& c) {
  const auto refuse = [](std::string message, std::string hint) {
    return Error{ErrorCode::kBadInput, "station.agent", std::move(message),
                 std::move(hint)};
  };
  if (c.team.empty()) return refuse("a formation needs aircraft.", "Add a group.");
  if (choice.slots.size() + 1 < c.team.size())
    return refuse(fmt::format("slots_m has {} places for {} followers.",
                              choice.slots.size(), c.team.size() - 1),
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
  options.team = c.team;
  options.route = choice.route;
  options.laps = choice.laps;
  options.slots = choice.slots;
  options.direct = choice.direct;
  for (const LeaderChange& change : choice.leaders) {
    const auto leader = static_cast<std::size_t>(change.aircraft);
    if (leader >= c.team.size())
      return refuse(fmt::format("aircraft {} cannot lead: there are {}, counted from 0.",
                                leader, c.team.size()),
                    "");
    options.leaders.push_back({change.at, leader});
  }
  return std::unique_ptr<Agent>(std::make_unique<reasoning::FormationControl>(options));
}

}  // namespace

Kinds<Agent, StationContext> station_agent_kinds() {
  Kinds<Agent, StationContext> kinds("station-agent");
  kinds.add("coordinator", "Keeps a fire's perimeter known; see `monitoring`.",
            Fields<CoordinatorChoice>(),
            [](const CoordinatorChoice&, const StationContext& c) {
              return make_coordinator(c);
            });
  kinds.add("formation", "Leader and followers; needs agents of kind `wingman`.",
            formation_fields(),
            [](const FormationChoice& choice, const StationContext& c) {
              return make_formation(choice, c);
            });
  kinds.add("listener", "Gives no orders, for aircraft that fly by themselves.",
            Fields<ListenerChoice>(), [](const ListenerChoice&, const StationContext&) {
              return std::unique_ptr<Agent>(std::make_unique<reasoning::Listener>());
            });
  return kinds;
}

}  // namespace skein::assemble
