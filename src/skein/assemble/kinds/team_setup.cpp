// SPDX-License-Identifier: Apache-2.0
#include "skein/assemble/kinds/team_setup.h"

#include <map>
#include <string>
#include <utility>

#include "skein/assemble/kinds/aircraft_fit.h"
#include "skein/assemble/kinds/contexts.h"
#include "skein/assemble/kinds/routine_periods.h"
#include "skein/assemble/world/aircraft_builder.h"
#include "skein/layer/reasoning/team/onboard/task_needs.h"

namespace skein::assemble {
namespace {

using reasoning::TaskSharing;
using reasoning::TeamConfig;
using reasoning::TeamStructure;
using scenario::TeamSetup;

constexpr double kAllocateAgain = 5;  // [s]

bool leads_itself(const TeamSetup& setup) {
  return setup.structure != TeamSetup::Structure::kNone;
}

TaskSharing sharing_of(const TeamSetup& setup) {
  switch (setup.allocation) {
    case TeamSetup::Allocation::kCoalitions:
      return TaskSharing::kCoalitions;
    case TeamSetup::Allocation::kSequences:
      return TaskSharing::kSequences;
    case TeamSetup::Allocation::kNearest:
      break;
  }
  return TaskSharing::kNearest;
}

// The station and its aircraft, which come after all stations.
std::map<EntityId, std::string> members_of(const scenario::Scenario& scenario,
                                           std::size_t station) {
  std::map<EntityId, std::string> members = {
      {EntityId{static_cast<std::uint32_t>(station)}, scenario.stations[station].name}};
  EntityId next{static_cast<std::uint32_t>(scenario.stations.size())};
  const auto names = aircraft_names(scenario);
  for (std::size_t g = 0; g < names.size(); ++g) {
    const bool own = station_of(scenario, scenario.aircraft[g]) == station;
    for (const std::string& name : names[g]) {
      if (own) members[next] = name;
      ++next.value;
    }
  }
  return members;
}

TeamConfig team_config(const scenario::Scenario& scenario, std::size_t station,
                       const RadioParts& parts) {
  const TeamSetup& setup = scenario.stations[station].team;
  const EntityId id{static_cast<std::uint32_t>(station)};
  TeamConfig config;
  config.times.query_period = setup.query_period ? setup.query_period->seconds()
                                                 : routine_periods(scenario, parts).query;
  config.times.mission_diameter = setup.diameter.value_or(0);
  config.times.radio_range = radio_range(scenario.radio, parts);
  config.seed = scenario.seed;
  config.names = members_of(scenario, station);
  for (const auto& [member, name] : config.names) config.known.insert(member);
  config.approval = setup.approval;
  config.allocation_period =
      sharing_of(setup) == TaskSharing::kNearest ? 0 : kAllocateAgain;
  switch (setup.structure) {
    case TeamSetup::Structure::kNone:
      config.structure = TeamStructure::kNone;
      break;
    case TeamSetup::Structure::kLeader:
      config.structure = TeamStructure::kMaster;
      config.operators = {id};
      break;
    case TeamSetup::Structure::kFixedLeader:
      config.structure = TeamStructure::kFixedMaster;
      config.fixed_leader = id;
      break;
    case TeamSetup::Structure::kAuction:
      config.structure = TeamStructure::kAuction;
      break;
  }
  return config;
}

}  // namespace

std::shared_ptr<const reasoning::OnboardTeamOptions> onboard_team(
    const scenario::Scenario& scenario, std::size_t station,
    const AircraftContext& context, const RadioParts& parts) {
  const TeamSetup& setup = scenario.stations[station].team;
  if (!leads_itself(setup)) return nullptr;
  auto options = std::make_shared<reasoning::OnboardTeamOptions>();
  options->config = team_config(scenario, station, parts);
  options->sharing = sharing_of(setup);
  options->cruise = context.limits.airspeed;
  std::uint32_t sensors = 0;
  if (context.has_camera) sensors |= kCameraSensor;
  if (context.has_fire_sensor) sensors |= kFireSensor;
  if (context.limits.slowest <= 0) sensors |= kHovers;
  options->sensors = sensors;
  return options;
}

std::function<std::shared_ptr<reasoning::TeamServer>()> team_server(
    const scenario::Scenario& scenario, std::size_t station, const Vec3& place,
    std::vector<Zone> zones, const RadioParts& parts) {
  const TeamSetup& setup = scenario.stations[station].team;
  if (!leads_itself(setup)) return {};
  auto desk = std::make_shared<reasoning::TeamServer>(reasoning::TeamServerOptions{
      EntityId{static_cast<std::uint32_t>(station)},
      team_config(scenario, station, parts), sharing_of(setup), place, std::move(zones)});
  return [desk] { return desk; };
}

}  // namespace skein::assemble
