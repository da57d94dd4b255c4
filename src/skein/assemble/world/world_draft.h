// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "skein/assemble/kinds/contexts.h"
#include "skein/assemble/kinds/kind_registry.h"
#include "skein/assemble/world/aircraft_builder.h"
#include "skein/assemble/world/build.h"
#include "skein/base/result.h"
#include "skein/data/airspace/zone.h"
#include "skein/geo/local_frame.h"
#include "skein/role/terrain.h"
#include "skein/scenario/scenario.h"

namespace skein::assemble {

/// How this program names itself to others.
std::string software();

/// A world while it is made of a scenario, part by part. What fails is replaced by
/// something plain until the end, so that all errors are found at once.
struct WorldDraft {
  /// All references outlive it. Zones that are in force from the start are there.
  WorldDraft(const scenario::Scenario& described, const KindRegistry& registry,
             geo::LocalFrame local_frame, RecordedReports* reports);
  WorldDraft(const WorldDraft&) = delete;
  WorldDraft& operator=(const WorldDraft&) = delete;

  /// Whether something was made; if not, notes why.
  template <class T>
  bool note(const Result<T>& made) {
    if (!made) errors.push_back(made.error());
    return made.ok();
  }

  /// The world, or all errors as one.
  Result<Build> finished();

  const scenario::Scenario& scenario;
  const KindRegistry& kinds;
  geo::LocalFrame frame;
  std::vector<Zone> zones;             ///< in force from the start
  std::shared_ptr<const Terrain> map;  ///< the world's terrain; null until it is made
  RecordedReports* recorded;           ///< null: vehicles speak for themselves
  std::vector<StationTeam> teams;      ///< of each station
  Build build;
  std::vector<Error> errors;
};

/// Makes terrain and wind, and what all that is made next in the environment is given.
EnvironmentContext make_surroundings(WorldDraft& draft);

/// Notes what does not fit together of an aircraft that was made; of the first of its
/// group its warnings, too. Whether it fits.
bool note_fit(WorldDraft& draft, const scenario::AircraftGroup& group, int index,
              const simulation::Entity& aircraft);

/// Where the antenna of a station is, in N [m]. After make_surroundings().
Vec3 antenna_of(const WorldDraft& draft, const scenario::Station& station);

/// Puts the ground stations, with their missions, before the aircraft.
void add_stations(WorldDraft& draft);

/// Makes the links to ground stations outside, and shows them all simulated aircraft.
void make_station_links(WorldDraft& draft);

}  // namespace skein::assemble
