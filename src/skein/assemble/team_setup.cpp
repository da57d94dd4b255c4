#include "skein/assemble/team_setup.h"

#include "skein/assemble/aircraft_fit.h"
#include "skein/assemble/contexts.h"
#include "skein/layer/reasoning/team/onboard/task_needs.h"

namespace skein::assemble {
namespace {

using reasoning::TeamConfig;
using reasoning::TeamStructure;
using scenario::TeamSetup;

constexpr double kAllocateAgain = 5;  // [s]

bool leads_itself(const TeamSetup& setup) {
  return setup.structure != TeamSetup::Structure::kNone;
}

bool is_in_wind(const TeamSetup& setup) {
  return setup.allocation == TeamSetup::Allocation::kCoalitions;
}

// The station and its aircraft, which come after all stations.
std::set<EntityId> members_of(const scenario::Scenario& scenario, std::size_t station) {
  std::set<EntityId> ids = {EntityId{static_cast<std::uint32_t>(station)}};
  EntityId next{static_cast<std::uint32_t>(scenario.stations.size())};
  for (const scenario::AircraftGroup& group : scenario.aircraft) {
    const bool own = station_of(scenario, group) == station;
    for (int i = 0; i < group.count; ++i, ++next.value)
      if (own) ids.insert(next);
  }
  return ids;
}

TeamConfig team_config(const scenario::Scenario& scenario, std::size_t station) {
  const TeamSetup& setup = scenario.stations[station].team;
  const EntityId id{static_cast<std::uint32_t>(station)};
  TeamConfig config;
  config.times.query_period = setup.query_period.seconds();
  config.times.mission_diameter = setup.diameter.value_or(0);
  config.times.radio_range = radio_range(scenario.radio);
  config.seed = scenario.seed;
  config.known = members_of(scenario, station);
  config.allocation_period = is_in_wind(setup) ? kAllocateAgain : 0;
  switch (setup.structure) {
    case TeamSetup::Structure::kNone:
      config.structure = TeamStructure::kNone;
      break;
    case TeamSetup::Structure::kMaster:
      config.structure = TeamStructure::kMaster;
      config.operators = {id};
      break;
    case TeamSetup::Structure::kFixedMaster:
      config.structure = TeamStructure::kFixedMaster;
      config.fixed_master = id;
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
    const AircraftContext& context) {
  const TeamSetup& setup = scenario.stations[station].team;
  if (!leads_itself(setup)) return nullptr;
  auto options = std::make_shared<reasoning::OnboardTeamOptions>();
  options->config = team_config(scenario, station);
  options->in_wind = is_in_wind(setup);
  options->cruise = context.limits.airspeed;
  std::uint32_t sensors = 0;
  if (context.has_camera) sensors |= reasoning::kCameraSensor;
  if (context.has_fire_sensor) sensors |= reasoning::kFireSensor;
  if (context.limits.slowest <= 0) sensors |= reasoning::kHovers;
  options->sensors = sensors;
  return options;
}

std::function<std::shared_ptr<reasoning::TeamDesk>()> team_desk(
    const scenario::Scenario& scenario, std::size_t station, const Vec3& place) {
  const TeamSetup& setup = scenario.stations[station].team;
  if (!leads_itself(setup)) return {};
  auto desk = std::make_shared<reasoning::TeamDesk>(
      EntityId{static_cast<std::uint32_t>(station)}, team_config(scenario, station),
      is_in_wind(setup), place);
  return [desk] { return desk; };
}

}  // namespace skein::assemble
