// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "skein/assemble/kinds/kind_registry.h"
#include "skein/assemble/kinds/modem_setup.h"
#include "skein/base/result.h"
#include "skein/data/event/record.h"
#include "skein/geo/local_frame.h"
#include "skein/link/transport/endpoint_address.h"
#include "skein/scenario/scenario.h"
#include "skein/simulation/run.h"
#include "skein/simulation/world.h"

namespace skein::vehicle_links {
class VehicleFeed;
class VehicleLinks;
}  // namespace skein::vehicle_links
namespace skein::world_link {
class EntityLinks;
class WorldClient;
class WorldFeed;
}  // namespace skein::world_link

namespace skein::assemble {

/// A scenario made real: a world that can be run once.
struct Build {
  Build();
  Build(Build&&) noexcept;
  Build& operator=(Build&&) noexcept;
  ~Build();

  /// To vehicles and ground stations outside. Whoever runs the world calls start() first,
  /// unless it is a run that is done again. Outlives the world.
  std::unique_ptr<vehicle_links::VehicleLinks> links;
  /// Shows simulated aircraft to ground stations: a listener of the records, and a source
  /// of commands. Null: nobody is to see them.
  std::unique_ptr<vehicle_links::VehicleFeed> feed;
  /// To entities whose agents are in other programs; started like `links`.
  std::unique_ptr<world_link::EntityLinks> entity_links;
  /// To a real modem, of the world or of a single agent; started like `links`. Null:
  /// none.
  std::unique_ptr<modem::ModemLink> modem;
  /// Of a single agent: the link to its world, which is started too, and the listener of
  /// the records that tells the world. Null: this is the world.
  std::unique_ptr<world_link::WorldClient> world_client;
  std::unique_ptr<world_link::WorldFeed> world_feed;
  /// Programs that open_links() starts, and who is asked before; null: none is started.
  std::vector<std::vector<std::string>> commands;
  std::shared_ptr<CodeConsent> consent;
  scenario::Source source;  ///< of the scenario
  bool mixed = false;       ///< an aircraft goes by the wall clock, and so must the run
  simulation::World world;
  simulation::RunOptions options;  ///< speed and threads are the caller's
  /// What was repaired in outside data, and what cannot be done as asked for.
  std::vector<std::string> warnings;
  /// Middle of maps: where the first mission is flown, else at the first station [m].
  Vec2 map_centre = Vec2::Zero();
};

/// Makes the world of a scenario that has passed the reader's checks. Entity 0 is the
/// ground station, then the aircraft in the order of their groups.
/// @param kinds     that the scenario was read with; the world does not need them any
///                  more.
/// @param recorded  what vehicles that are not simulated said in a run that is done
///                  again; without, they speak for themselves.
/// Fails: what terrain, wind or fire cannot be made from; an aircraft that starts inside
///        terrain or a no-fly zone.
Result<Build> build(const scenario::Scenario& scenario, const KindRegistry& kinds,
                    std::span<const VehicleReportRecord> recorded);
Result<Build> build(const scenario::Scenario& scenario, const KindRegistry& kinds);

/// An agent in a program of its own, and whom it meets.
struct AgentOrder {
  std::string entity;                               ///< an aircraft of the scenario
  std::optional<transport::EndpointAddress> world;  ///< none: it is alone
  std::vector<transport::EndpointAddress> team;     ///< other agents, directly
  std::optional<AgentModem> modem;  ///< its messages go over it; none: by the world
};

/// Makes one aircraft of a scenario with its agent and its surroundings, without anybody
/// else: the others, the missions and what the payload looks at are in the world that it
/// takes part in. It takes part from the start on.
/// Fails: as build(); an aircraft that the scenario does not have, or whose vehicle is to
///        be in yet another program.
Result<Build> build_agent(const scenario::Scenario& scenario, const KindRegistry& kinds,
                          const AgentOrder& order);

/// Heights of the ground for a map: `count` x `count` points about `centre`.
struct TerrainPatch {
  int rows = 0;
  Vec2 low = Vec2::Zero();
  double spacing = 0;
  std::vector<float> heights;
};
TerrainPatch sample_terrain(const Terrain& terrain, const Vec2& centre, double half_size);

}  // namespace skein::assemble
