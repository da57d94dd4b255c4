// SPDX-License-Identifier: Apache-2.0
// Ground stations of a world, and the missions that they pursue.
#include <fmt/format.h>

#include <set>
#include <utility>

#include "skein/assemble/kinds/aircraft_fit.h"
#include "skein/assemble/kinds/kinds_of.h"
#include "skein/assemble/kinds/team_setup.h"
#include "skein/assemble/world/world_draft.h"
#include "skein/exchange/plan/plan_reading.h"
#include "skein/layer/reasoning/station/ground_station.h"
#include "skein/layer/reasoning/station/nearest_allocator.h"
#include "skein/scenario/zones.h"
#include "skein/solve/path/aa_star.h"

namespace skein::assemble {
namespace {

// Of each station.
std::vector<std::vector<reasoning::PlannedMission>> missions(WorldDraft& draft) {
  MissionContext context{draft.scenario.seed,
                         draft.kinds.kinds(),
                         draft.teams,
                         draft.zones,
                         {},
                         std::make_shared<solve::AaStar>(),
                         draft.scenario.record.metrics_period,
                         [&draft](const std::string& file) {
                           return exchange::read_plan(file, draft.frame);
                         }};
  for (const scenario::PlacedObject& object : draft.scenario.environment.objects)
    context.objects.push_back(object.name);
  context.phenomena = draft.scenario.environment.phenomena.size();
  std::vector<std::vector<reasoning::PlannedMission>> all(draft.teams.size());
  std::set<std::string> names;
  for (std::size_t k = 0; k < draft.scenario.missions.size(); ++k) {
    auto made = draft.kinds.kinds().mission.make(draft.scenario.missions[k], context);
    if (made && !names.insert(made.value()->name).second)
      made =
          Error{ErrorCode::kBadInput, "name",
                fmt::format("another mission is called \"{}\" too.", made.value()->name),
                "Give each a name of its own."};
    if (made) {
      all[made.value()->station.value].push_back(std::move(*made.value()));
      continue;
    }
    Error error = made.error();
    error.place =
        fmt::format("missions[{}]{}{}", k, error.place.empty() ? "" : ".", error.place);
    draft.errors.push_back(error);
  }
  return all;
}

// Of whoever says which zones are in force.
reasoning::ZoneServerOptions server_options(const WorldDraft& draft,
                                            const StationTeam& station) {
  reasoning::ZoneServerOptions options;
  for (const TeamAircraft& each : station.team) options.team.push_back(each.id);
  options.known = options.drawn = draft.zones;
  for (const scenario::NoFlightZone& described : draft.scenario.environment.zones) {
    const Zone zone = scenario::to_zone(described);
    if (!described.active) options.drawn.push_back(zone);
  }
  return options;
}

std::unique_ptr<Agent> ground_station(const WorldDraft& draft, const StationTeam& station,
                                      std::vector<reasoning::PlannedMission> missions) {
  const scenario::Station& described = draft.scenario.stations[station.id.value];
  reasoning::GroundStationOptions options;
  options.id = station.id;
  for (const TeamAircraft& each : station.team)
    options.team.push_back({each.id, each.name, each.place});
  options.position.p_N = antenna_of(draft, described);
  options.heartbeat = heartbeat(draft.scenario, described);
  options.zones = server_options(draft, station);
  options.name = described.name;
  if (station.desk) options.desk = station.desk();
  return std::make_unique<reasoning::GroundStation>(
      options, std::move(missions), std::make_unique<reasoning::NearestAllocator>());
}

}  // namespace

Vec3 antenna_of(const WorldDraft& draft, const scenario::Station& station) {
  const Vec2& at = station.position;
  return {at.x(), at.y(), -(draft.map->elevation_msl(at) + station.antenna_agl)};
}

void add_stations(WorldDraft& draft) {
  std::vector<simulation::Entity> all;
  auto wanted = missions(draft);
  draft.build.map_centre = draft.scenario.stations.front().position;
  if (!wanted.front().empty())
    draft.build.map_centre =
        wanted.front().front().mission->demand().place.value_or(draft.build.map_centre);
  for (std::size_t k = 0; k < draft.scenario.stations.size(); ++k) {
    const scenario::Station& station = draft.scenario.stations[k];
    simulation::Entity& entity = all.emplace_back();
    entity.name = station.name;
    entity.kind = "station";
    entity.reality = entity_reality(Reality::kVirtual, Reality::kNone);
    entity.agent = ground_station(draft, draft.teams[k], std::move(wanted[k]));
    entity.agent_period = station.agent_period;
    entity.active = {{Time(), draft.scenario.duration + Time::from_ns(1)}};
  }
  for (simulation::Entity& each : draft.build.world.entities)
    all.push_back(std::move(each));
  draft.build.world.entities = std::move(all);
}

}  // namespace skein::assemble
