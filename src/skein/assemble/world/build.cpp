// SPDX-License-Identifier: Apache-2.0
#include "skein/assemble/world/build.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "skein/assemble/kinds/aircraft_fit.h"
#include "skein/assemble/kinds/kinds_of.h"
#include "skein/assemble/kinds/modem_setup.h"
#include "skein/assemble/kinds/sampling.h"
#include "skein/assemble/kinds/team_setup.h"
#include "skein/assemble/world/aircraft_builder.h"
#include "skein/assemble/world/read_command.h"
#include "skein/assemble/world/run_options.h"
#include "skein/assemble/world/run_radio.h"
#include "skein/assemble/world/server_memory.h"
#include "skein/assemble/world/traffic.h"
#include "skein/assemble/world/world_draft.h"
#include "skein/link/modem/modem_link.h"
#include "skein/link/vehicle_links/vehicle_feed.h"
#include "skein/link/world_link/agent_parts.h"
#include "skein/link/world_link/entity_links.h"
#include "skein/role/moving_object.h"
#include "skein/role/phenomenon.h"
#include "skein/role/radio.h"
#include "skein/role/traffic_aircraft.h"
#include "skein/role/vehicle.h"
#include "skein/role/world_memory.h"
#include "skein/scenario/zones.h"
#include "skein/simulation/commanded_wind.h"

namespace skein::assemble {
namespace {

using scenario::AircraftGroup;

// What the scenario commands by itself.
std::vector<CommandRecord> planned_commands(WorldDraft& draft) {
  std::vector<CommandRecord> all;
  for (const scenario::NoFlightZone& zone : draft.scenario.environment.zones)
    for (const scenario::ZoneSwitch& change : zone.switches)
      all.push_back(
          {change.at, "scenario", ZoneChange{0, change.on, scenario::to_zone(zone)}});
  for (const scenario::PlannedCommand& planned : draft.scenario.commands) {
    auto command =
        read_command(planned.text, draft.frame, draft.kinds.table().task_forms());
    if (draft.note(command))
      all.push_back({planned.at, "scenario", std::move(command).value()});
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const auto& a, const auto& b) { return a.time < b.time; });
  return all;
}

// What is not as it may be meant, but no error.
std::vector<std::string> warnings_of(const WorldDraft& draft) {
  std::vector<std::string> all = sampling_warnings(draft.scenario, draft.kinds.table());
  for (std::string& warning : memory_warnings(draft.scenario))
    all.push_back(std::move(warning));
  for (std::string& warning : scenario::zone_warnings(draft.scenario.environment))
    all.push_back(std::move(warning));
  if (std::all_of(draft.scenario.aircraft.begin(), draft.scenario.aircraft.end(),
                  [](const AircraftGroup& group) { return group.count == 0; }))
    all.emplace_back(
        "no aircraft: nothing is flown, and nobody watches the fire. Give aircraft a "
        "group with a count above 0.");
  return all;
}

void add_phenomena(WorldDraft& draft, const EnvironmentContext& context) {
  for (const scenario::Choice& chosen : draft.scenario.environment.phenomena) {
    auto made = draft.kinds.kinds().phenomenon.make(chosen, context);
    if (draft.note(made)) draft.build.world.phenomena.push_back(std::move(made).value());
  }
}

void make_modem(WorldDraft& draft) {
  if (!modem_of(draft.scenario.radio)) return;
  auto made = make_world_modem(draft.scenario);
  if (draft.note(made)) draft.build.modem = std::move(made).value();
}

// Of each station, without its aircraft yet.
void make_teams(WorldDraft& draft) {
  for (const scenario::Station& station : draft.scenario.stations) {
    const auto k = static_cast<std::uint32_t>(draft.teams.size());
    draft.teams.push_back({EntityId{k},
                           station.name,
                           {},
                           team_server(draft.scenario, k, antenna_of(draft, station),
                                       draft.zones, draft.kinds.kinds())});
  }
}

void add_aircraft(WorldDraft& draft) {
  AircraftBuilder builder(
      draft.scenario, draft.kinds.kinds(), draft.map, draft.zones,
      *draft.build.world.wind,
      {*draft.build.links, *draft.build.entity_links, nullptr, draft.build.modem.get()},
      draft.recorded);
  const auto first = static_cast<std::uint32_t>(draft.scenario.stations.size());
  for (const AircraftGroup& group : draft.scenario.aircraft) {
    StationTeam& station = draft.teams[station_of(draft.scenario, group)];
    for (int i = 0; i < group.count; ++i) {
      const auto next = static_cast<std::uint32_t>(draft.build.world.entities.size());
      auto made = builder.make(group, i, EntityId{first + next}, station.id);
      if (!draft.note(made)) break;  // the others of its group are alike
      if (!note_fit(draft, group, i, made.value())) break;
      station.team.push_back(builder.last());
      draft.build.mixed |= made.value().vehicle->real_time();
      draft.build.world.entities.push_back(std::move(made).value());
    }
  }
  draft.build.world.finds_aircraft = builder.finds_aircraft();
}

void add_objects(WorldDraft& draft) {
  std::uint32_t id = 0;
  for (const scenario::PlacedObject& object : draft.scenario.environment.objects) {
    auto movement = draft.kinds.kinds().movement.make(
        object.movement, {draft.scenario.seed, id, object.position});
    if (draft.note(movement)) {
      simulation::WorldObject& made = draft.build.world.objects.emplace_back(
          GroundObject{id, object.name, object.what}, std::move(movement).value());
      if (object.physical) made.body = body_of(object, id);
    }
    ++id;
  }
  draft.build.world.memory =
      server_memory(draft.scenario.environment.memory, draft.build.world, draft.map);
}

void add_traffic(WorldDraft& draft) {
  auto made = make_traffic(draft.scenario, draft.kinds.kinds(), draft.frame,
                           draft.build.world.entities, draft.build.warnings);
  if (draft.note(made)) draft.build.world.traffic = std::move(made).value();
}

void make_radio(WorldDraft& draft) {
  std::vector<Vec3> stations;
  for (const scenario::Station& station : draft.scenario.stations)
    stations.push_back(antenna_of(draft, station));
  RadioContext context = radio_context(draft.build.world, stations);
  context.seed = draft.scenario.seed;
  context.modem = draft.build.modem.get();
  context.kinds = &draft.kinds.kinds();
  auto made = draft.kinds.kinds().radio.make(draft.scenario.radio, context);
  if (draft.note(made)) draft.build.world.radio = std::move(made).value();
}

// The parts of a world, one after the other: each may need those before it.
Result<Build> build_from(const scenario::Scenario& scenario, const KindRegistry& kinds,
                         RecordedReports* recorded) {
  auto frame = geo::LocalFrame::at(scenario.origin);
  if (!frame) return frame.error();
  WorldDraft draft(scenario, kinds, std::move(frame).value(), recorded);
  draft.build.options = run_options(scenario, kinds.table());
  draft.build.options.commands = planned_commands(draft);
  draft.build.warnings = warnings_of(draft);
  draft.build.world.zones = draft.zones;
  const EnvironmentContext environment = make_surroundings(draft);
  add_phenomena(draft, environment);
  make_modem(draft);
  make_teams(draft);
  add_aircraft(draft);
  add_stations(draft);
  add_objects(draft);
  add_traffic(draft);
  make_radio(draft);
  make_station_links(draft);
  return draft.finished();
}

}  // namespace

Result<void> check_phenomenon(std::size_t number, std::size_t phenomena) {
  if (number < phenomena) return {};
  return Error{ErrorCode::kBadInput, "phenomenon",
               fmt::format("environment.phenomena has no number {}: there {} {}.", number,
                           phenomena == 1 ? "is" : "are", phenomena),
               "They are counted from 0."};
}

Build::Build() = default;
Build::Build(Build&&) noexcept = default;
Build& Build::operator=(Build&&) noexcept = default;
Build::~Build() = default;

Result<Build> build(const scenario::Scenario& scenario, const KindRegistry& kinds) {
  return build_from(scenario, kinds, nullptr);
}

Result<Build> build(const scenario::Scenario& scenario, const KindRegistry& kinds,
                    std::span<const VehicleReportRecord> recorded) {
  RecordedReports reports;
  for (const VehicleReportRecord& each : recorded)
    reports[each.id].push_back({each.time, each.value});
  return build_from(scenario, kinds, &reports);
}

TerrainPatch sample_terrain(const Terrain& terrain, const Vec2& centre,
                            double half_size) {
  constexpr int kRows = 161;
  TerrainPatch patch;
  patch.rows = kRows;
  patch.spacing = 2 * half_size / (kRows - 1);
  patch.low = centre - Vec2::Constant(half_size);
  for (int r = 0; r < kRows; ++r)
    for (int c = 0; c < kRows; ++c)
      patch.heights.push_back(static_cast<float>(
          terrain.elevation_msl(patch.low + patch.spacing * Vec2(r, c))));
  return patch;
}

}  // namespace skein::assemble
