// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "skein/data/command/command.h"
#include "skein/data/vehicle/airframe.h"
#include "skein/link/vehicle_links/shown_mode.h"
#include "skein/link/vehicle_links/traffic_feed.h"
#include "skein/link/vehicle_links/vehicle_links.h"
#include "skein/role/recorder.h"

namespace skein::vehicle_links {

/// A simulated aircraft that ground stations see.
struct ShownAircraft {
  std::string name;        ///< as the scenario has it
  std::size_t server = 0;  ///< its number among those of the links
  bool hovers = false;
  /// Shown as an ArduPilot's; else as a PX4's.
  bool ardupilot = true;
  /// Its agent flies what ground stations ask for; else it has tasks of its own, and what
  /// they ask for becomes one.
  bool commanded = false;
  double take_off_height = 50;  ///< [m]
};

/// Shows simulated aircraft to ground stations, and hands on what those ask for; shows
/// them to real vehicles as traffic.
///
/// As a listener of a run's records it knows how each aircraft is; as a source of
/// commands it says what ground stations ask for. Called by the simulation's thread.
class VehicleFeed final : public Recorder {
 public:
  /// @param links    outlives it.
  /// @param traffic  names of simulated aircraft that real vehicles are told of.
  VehicleFeed(VehicleLinks& links, std::vector<ShownAircraft> aircraft,
              const std::vector<std::string>& traffic = {});

  void record(const Record& record) override;
  Result<void> step_done(Time time) override;

  /// What ground stations have asked for since the last call, and what of it was refused.
  std::vector<CommandRecord> commands();

 private:
  struct Shown {
    ShownAircraft aircraft;
    vehicle_services::VehicleSnapshot snapshot;
    ShownMode mode;
    std::vector<MissionItem> mission;
    std::optional<Vec3> home_N;
    bool known = false;  // an estimate has been recorded
  };
  struct Listener;

  Shown* find(EntityId id);
  std::string aircraft_of(std::size_t server) const;
  void hear(Shown& shown, const VehicleRequest& request, std::vector<CommandRecord>& out);
  std::optional<Command> task_for(const Shown& shown,
                                  const VehicleRequest& request) const;

  VehicleLinks& links_;
  TrafficFeed traffic_;
  std::vector<Shown> shown_;
  std::map<EntityId, std::size_t> by_entity_;
  Time now_;
  bool paused_ = false;
};

}  // namespace skein::vehicle_links
