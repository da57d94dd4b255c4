// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "skein/data/vehicle/autopilot.h"
#include "skein/data/vehicle/vehicle_report.h"
#include "skein/data/vehicle/vehicle_request.h"

namespace skein::vehicle_links {

/// The mode and the state of arming that a simulated aircraft shows to ground stations:
/// what was asked for last, unless a pilot or a failsafe flies.
///
/// The simulation knows no arming. An aircraft is armed when a ground station has armed
/// it, while it flies, and until it has stood for ten seconds after a flight.
class ShownMode {
 public:
  /// @param commanded     flown by what ground stations ask for; else guided by its
  ///                      agent.
  /// @param stays_guided  a take-off is a part of guided flight, which goes on after it,
  ///                      as with ArduPilot's multirotors; others hold where it ended.
  ShownMode(bool commanded, bool stays_guided)
      : commanded_(commanded), stays_guided_(stays_guided) {}

  void hear(const VehicleRequest& request);
  void hear(Time now, const AutopilotStatus& status, double altitude_msl);
  /// Where the aircraft is in its stored mission.
  void hear(const MissionProgress& progress);

  VehicleMode mode() const { return mode_; }
  bool armed() const { return armed_; }

 private:
  bool commanded_, stays_guided_;
  VehicleMode asked_ = VehicleMode::kHold;
  VehicleMode mode_ = VehicleMode::kHold;
  bool armed_ = false, flew_ = false;
  double take_off_altitude_ = 0;  // [m]
  std::optional<Time> standing_since_;
};

}  // namespace skein::vehicle_links
