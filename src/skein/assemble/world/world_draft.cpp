// SPDX-License-Identifier: Apache-2.0
#include "skein/assemble/world/world_draft.h"

#include <fmt/format.h>

#include <utility>

#include "skein/assemble/kinds/aircraft_fit.h"
#include "skein/assemble/kinds/interface_version.h"
#include "skein/assemble/world/common_ground.h"
#include "skein/layer/environment/terrain/synthetic_terrain.h"
#include "skein/layer/environment/wind/uniform_wind.h"
#include "skein/link/vehicle_links/vehicle_links.h"
#include "skein/link/world_link/entity_links.h"
#include "skein/scenario/named_files.h"
#include "skein/scenario/zones.h"
#include "skein/simulation/commanded_wind.h"

namespace skein::assemble {
namespace {

// Wraps a shared terrain as the world's own: agents carry it as their map.
class SharedTerrain : public Terrain {
 public:
  explicit SharedTerrain(std::shared_ptr<const Terrain> terrain)
      : terrain_(std::move(terrain)) {}
  double elevation_msl(const Vec2& p) const override {
    return terrain_->elevation_msl(p);
  }
  Vec2 gradient(const Vec2& p) const override { return terrain_->gradient(p); }
  double highest_msl() const override { return terrain_->highest_msl(); }

 private:
  std::shared_ptr<const Terrain> terrain_;
};

// All errors as one.
Error together(const std::vector<Error>& errors) {
  if (errors.size() == 1) return errors.front();
  Error all{errors.front().code, "", fmt::format("{} problems:", errors.size()), ""};
  for (const Error& error : errors) all.message += "\n  " + error.text();
  return all;
}

}  // namespace

std::string software() {
  return fmt::format("Skein {}", kInterfaceVersion);
}

WorldDraft::WorldDraft(const scenario::Scenario& described, const KindRegistry& registry,
                       geo::LocalFrame local_frame, RecordedReports* reports)
    : scenario(described),
      kinds(registry),
      frame(std::move(local_frame)),
      recorded(reports) {
  const scenario::Environment& environment = scenario.environment;
  for (std::size_t i = 0; i < environment.zone_rings.size(); ++i)
    zones.push_back(scenario::ring_zone(environment.zone_rings[i], i));
  for (const scenario::NoFlightZone& zone : environment.zones)
    if (zone.active) zones.push_back(scenario::to_zone(zone));
  build.links = std::make_unique<vehicle_links::VehicleLinks>(frame);
  build.entity_links =
      std::make_unique<world_link::EntityLinks>(software(), common_ground(scenario));
  // What is started with the links, and who is asked.
  build.commands = scenario::named_commands(scenario, kinds.table());
  build.consent = kinds.consent();
  build.source = scenario.source;
}

Result<Build> WorldDraft::finished() {
  if (!errors.empty()) return together(errors);
  return std::move(build);
}

EnvironmentContext make_surroundings(WorldDraft& draft) {
  EnvironmentContext context{
      draft.frame, draft.scenario.start_utc, draft.scenario.seed, nullptr,
      nullptr,     &draft.build.warnings};
  auto terrain =
      draft.kinds.kinds().terrain.make(draft.scenario.environment.terrain, context);
  // Far below everything where the real one is missing: nothing collides with it.
  if (draft.note(terrain))
    draft.map = std::move(terrain).value();
  else
    draft.map =
        std::make_shared<environment::FlatTerrain>(environment::FlatTerrainOptions{-1e5});
  draft.build.world.terrain = std::make_unique<SharedTerrain>(draft.map);
  context.terrain = draft.map.get();
  auto wind = draft.kinds.kinds().wind.make(draft.scenario.environment.wind, context);
  draft.build.world.wind = std::make_unique<simulation::CommandedWind>(
      draft.note(wind) ? std::move(wind).value()
                       : std::make_unique<environment::UniformWind>(
                             environment::UniformWindOptions{}));
  context.wind = draft.build.world.wind.get();
  return context;
}

bool note_fit(WorldDraft& draft, const scenario::AircraftGroup& group, int index,
              const simulation::Entity& aircraft) {
  const std::vector<Error> found =
      incompatibilities(draft.scenario, draft.kinds, group, aircraft);
  draft.errors.insert(draft.errors.end(), found.begin(), found.end());
  if (index == 0)
    for (const std::string& warning : warnings(draft.scenario, group, aircraft))
      draft.build.warnings.push_back(warning);
  return found.empty();
}

}  // namespace skein::assemble
