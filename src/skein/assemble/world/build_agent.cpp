// SPDX-License-Identifier: Apache-2.0
// One aircraft of a scenario with its agent, without the rest of its world.
#include <fmt/format.h>

#include <utility>

#include "skein/assemble/kinds/aircraft_fit.h"
#include "skein/assemble/kinds/kinds_of.h"
#include "skein/assemble/kinds/modem_setup.h"
#include "skein/assemble/kinds/remote_kind.h"
#include "skein/assemble/kinds/team_setup.h"
#include "skein/assemble/world/aircraft_builder.h"
#include "skein/assemble/world/common_ground.h"
#include "skein/assemble/world/run_options.h"
#include "skein/assemble/world/world_draft.h"
#include "skein/link/modem/modem_parts.h"
#include "skein/link/world_link/agent_parts.h"
#include "skein/role/agent.h"
#include "skein/role/radio.h"
#include "skein/simulation/commanded_wind.h"

namespace skein::assemble {
namespace {

using scenario::AircraftGroup;

// Stands for the agents of others where only one is at home.
class AbsentAgent final : public Agent {
 public:
  void step(const AgentInput&, AgentOutput&) override {}
};

// Joins the world that the aircraft takes part in; who it is there.
Result<EntityId> join_world(WorldDraft& draft, const AgentOrder& order) {
  world_link::WorldClientOptions options;
  options.entity = order.entity;
  options.software = software();
  options.scenario = common_ground(draft.scenario);
  options.world = order.world;
  options.team = order.team;
  std::size_t entity = draft.scenario.stations.size();
  std::string all;
  bool found = false;
  for (const auto& group : aircraft_names(draft.scenario))
    for (const std::string& name : group) {
      all += (all.empty() ? "" : ", ") + name;
      found |= name == order.entity;
      if (name == order.entity)
        options.self = EntityId{static_cast<std::uint32_t>(entity)};
      ++entity;
    }
  if (!found)
    return Error{ErrorCode::kBadInput, order.entity,
                 fmt::format("is no aircraft of the scenario; it has: {}.", all), ""};
  options.entities = entity;
  const EntityId self = options.self;
  draft.build.world_client =
      std::make_unique<world_link::WorldClient>(std::move(options));
  draft.build.world_feed =
      std::make_unique<world_link::WorldFeed>(*draft.build.world_client, self);
  return self;
}

void add_absent(WorldDraft& draft, const std::string& name, const char* kind) {
  simulation::Entity& entity = draft.build.world.entities.emplace_back();
  entity.name = name;
  entity.kind = kind;
  entity.agent = std::make_unique<AbsentAgent>();
  entity.agent_period = draft.scenario.step;
}

// The aircraft of this program; others stand in the list, so that numbers are those of
// the world, and never take part.
void add_only_aircraft(WorldDraft& draft, EntityId self) {
  AircraftBuilder builder(
      draft.scenario, draft.kinds.kinds(), draft.map, draft.zones,
      *draft.build.world.wind,
      {*draft.build.links, *draft.build.entity_links, draft.build.world_client.get()},
      nullptr);
  for (const scenario::Station& station : draft.scenario.stations)
    add_absent(draft, station.name, "station");
  const auto names = aircraft_names(draft.scenario);
  for (std::size_t g = 0; g < names.size(); ++g) {
    const AircraftGroup& group = draft.scenario.aircraft[g];
    for (std::size_t i = 0; i < names[g].size(); ++i) {
      if (draft.build.world.entities.size() != self.value) {
        add_absent(draft, names[g][i], "aircraft");
        continue;
      }
      const int index = static_cast<int>(i);
      if (group.vehicle.kind == kRemoteKind)
        draft.errors.push_back({ErrorCode::kBadInput, names[g][i] + ": vehicle",
                                "is in another program; this is that program.",
                                "Choose simulated or mavlink."});
      const auto station = static_cast<std::uint32_t>(station_of(draft.scenario, group));
      auto made = builder.make(group, index, self, EntityId{station});
      if (!draft.note(made) || !note_fit(draft, group, index, made.value())) return;
      draft.build.world.entities.push_back(std::move(made).value());
      draft.build.world.entities.back().active = {
          {Time(), draft.scenario.duration + Time::from_ns(1)}};
      draft.build.map_centre = builder.last().place;
    }
  }
}

void make_agent_radio(WorldDraft& draft, EntityId self, const AgentOrder& order) {
  if (!order.modem) {
    draft.build.world.radio =
        std::make_unique<world_link::WorldRadio>(*draft.build.world_client);
    return;
  }
  auto made = make_agent_modem(draft.scenario, self, *order.modem);
  if (!draft.note(made)) return;
  draft.build.modem = std::move(made).value();
  std::vector<std::string> names;
  for (const simulation::Entity& entity : draft.build.world.entities)
    names.push_back(entity.name);
  draft.build.world.radio = std::make_unique<modem::AgentModemRadio>(
      *draft.build.modem, self, std::move(names));
}

}  // namespace

Result<Build> build_agent(const scenario::Scenario& scenario, const KindRegistry& kinds,
                          const AgentOrder& order) {
  auto frame = geo::LocalFrame::at(scenario.origin);
  if (!frame) return frame.error();
  WorldDraft draft(scenario, kinds, std::move(frame).value(), nullptr);
  draft.build.options = run_options(scenario, kinds.table());
  // The world is told of every step.
  draft.build.options.record_period = draft.build.options.step;
  draft.build.mixed = true;
  const auto self = join_world(draft, order);
  if (!self) return self.error();
  make_surroundings(draft);
  add_only_aircraft(draft, self.value());
  make_agent_radio(draft, self.value(), order);
  return draft.finished();
}

}  // namespace skein::assemble
