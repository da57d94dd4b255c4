// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "skein/assemble/kinds/contexts.h"
#include "skein/base/result.h"
#include "skein/role/autopilot.h"
#include "skein/scenario/fields.h"

#include "skein/layer/autopilot/skein/skein_setup.h"

namespace skein::assemble {

/// Where an aircraft may fly, as a scenario says it.
struct FenceChoice {
  std::vector<geo::Ring> areas;
  std::optional<double> ceiling_msl, floor_msl;
  double margin = 0;
  std::optional<double> look_ahead;  // [s]
};

/// What one lap of a route is flown with; none: as every other flight.
struct LapGainsChoice {
  std::optional<autopilot::LateralOptions> lateral;
  std::optional<autopilot::FixedWingGains> wing_gains;
};

/// The autopilot `skein` as a scenario chooses it.
struct SkeinChoice {
  autopilot::SkeinOptions options;
  FenceChoice fence;
  /// Gains; none: those of the aircraft's file, else the autopilot's own.
  std::optional<autopilot::FixedWingGains> wing_gains;
  std::optional<autopilot::MultirotorGains> rotor_gains;
  std::vector<LapGainsChoice> lap_gains;
};

/// The fence as the autopilot is given it.
autopilot::GeofenceOptions geofence_of(const FenceChoice& fence,
                                       const FlightLimits& limits);

scenario::Fields<SkeinChoice> skein_fields();
scenario::Fields<autopilot::LateralOptions> lateral_fields();

/// The gains of a fixed wing: the scenario's, else those of its aircraft file, else the
/// autopilot's own.
autopilot::LapGains fixed_wing_gains(const SkeinChoice& choice,
                                     const AircraftGains& of_aircraft);

/// Fails: failsafes that cannot be; areas that are none.
Result<std::unique_ptr<Autopilot>> make_skein(const SkeinChoice& choice,
                                              const AircraftContext& context);

}  // namespace skein::assemble
