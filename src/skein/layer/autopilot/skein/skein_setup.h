// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "skein/data/vehicle/airframe.h"
#include "skein/data/vehicle/vehicle.h"
#include "skein/layer/autopilot/control/fixed_wing_gains.h"
#include "skein/layer/autopilot/control/multirotor_gains.h"
#include "skein/layer/autopilot/estimator/estimator_options.h"
#include "skein/layer/autopilot/guidance/fixed_wing_guidance.h"
#include "skein/layer/autopilot/guidance/multirotor_guidance.h"
#include "skein/layer/autopilot/modes/consumption.h"
#include "skein/layer/autopilot/modes/failsafe.h"
#include "skein/layer/autopilot/modes/geofence.h"
#include "skein/layer/autopilot/modes/mode_logic.h"
#include "skein/layer/autopilot/modes/motor_watch.h"

namespace skein::autopilot {

/// For a plant that holds its own attitude.
struct PointGains {
  double altitude_gain = 0.3;  ///< climb rate per altitude error [1/s]
};

/// What a fixed wing flies one lap of a route with.
struct LapGains {
  LateralOptions lateral;
  FixedWingGains wing;
};

struct SkeinOptions {
  EstimatorOptions estimator;
  FixedWingGuidanceOptions wing_guidance;
  MultirotorGuidanceOptions rotor_guidance;
  FixedWingGains wing_gains;
  MultirotorGains rotor_gains;
  PointGains point_gains;
  FailsafeOptions failsafe;
  GeofenceOptions fence;
  /// Heartbeats and positions are to come: their silence counts from the start on.
  bool watches_link = false, watches_gnss = false;
  std::uint8_t watches_sensors = 0;  ///< likewise, bit k: FlightSensor k
  MotorWatchOptions motor_watch;
  ConsumptionOptions consumption;
  /// Fixed wings: lap k of FlyWaypoints is flown with entry k, those beyond the last with
  /// the last; everything else as the first lap. Empty: `wing_guidance.lateral` and
  /// `wing_gains` always.
  std::vector<LapGains> lap_gains;
};

/// Everything about the autopilot that does not change in flight, worked out once for all
/// aircraft of a kind.
struct SkeinSetup {
  /// `options` without error_in(options.failsafe).
  SkeinSetup(const SkeinOptions& options, const FlightLimits& limits,
             const Airframe& airframe);

  SkeinOptions options;
  FlightLimits limits;
  Airframe airframe;
  ModeRules rules;
  Geofence fence;
  HomeFlight home_flight;                      ///< without powers
  std::shared_ptr<const FixedWingSetup> wing;  ///< null for other airframes
  /// One for each of lap_gains; for fixed wings only.
  std::vector<std::shared_ptr<const FixedWingSetup>> lap_wings;
  std::shared_ptr<const MultirotorSetup> rotors;  ///< null for other airframes
};

}  // namespace skein::autopilot
