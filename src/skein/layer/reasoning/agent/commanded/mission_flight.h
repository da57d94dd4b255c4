// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "skein/data/vehicle/agent_step.h"
#include "skein/data/vehicle/vehicle_report.h"
#include "skein/data/vehicle/vehicle_request.h"

namespace skein::reasoning {

/// Flies a stored mission item after item. Waypoints that follow one another are one
/// route, whose corners the autopilot flies as it does.
class MissionFlight {
 public:
  /// @param limits  of the vehicle.
  explicit MissionFlight(const FlightLimits& limits) : limits_(limits) {}

  /// Replaces the items; what is flown ends.
  void load(std::vector<MissionItem> items);
  /// Flies from an item on.
  void start(std::uint16_t item);
  void stop() { flies_ = false; }

  bool empty() const { return items_.empty(); }
  bool flies() const { return flies_; }
  MissionProgress progress() const { return {current_, finished_}; }

  /// What to command now; nothing while what was commanded goes on.
  std::optional<AutopilotCommand> step(const AgentInput& in);

 private:
  AutopilotCommand command_for(const AgentInput& in) const;
  bool is_done(const AgentInput& in);
  void advance(const AgentInput& in);
  bool near(const Vec3& place, const NavEstimate& nav) const;
  bool waypoint(std::size_t item) const {
    return item < items_.size() && items_[item].kind == MissionItem::Kind::kWaypoint;
  }

  FlightLimits limits_;
  std::vector<MissionItem> items_;
  std::vector<std::uint16_t> jumped_;  // how often each jump was taken
  std::uint16_t current_ = 0;
  bool flies_ = false, finished_ = false;
  bool begun_ = false;     // the current item was commanded
  bool in_route_ = false;  // as a part of a route that is flown already
  std::optional<double> airspeed_;
  std::optional<Time> there_;  // since when, of a hold
};

}  // namespace skein::reasoning
