// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "skein/base/time.h"
#include "skein/data/airspace/zone.h"
#include "skein/data/vehicle/vehicle.h"
#include "skein/data/vehicle/vehicle_report.h"
#include "skein/geo/vec.h"
#include "skein/link/vehicle_services/parameter_service.h"

namespace skein::vehicle_services {

/// Two clocks: links are kept by the wall clock, what is flown by the run's.
struct Clocks {
  Time wall;       ///< any steady clock
  Time simulated;  ///< of the run
};

/// How a simulated vehicle is, after a step of the simulation.
struct VehicleSnapshot {
  VehicleMotion motion;        ///< as its estimator has it
  VehicleCondition condition;  ///< `mode` is what ground stations are shown
  MissionProgress progress;    ///< in the mission that was uploaded last
  double throttle = 0;         ///< now, 0 to 1
  Vec3 home_N = Vec3::Zero();  ///< where it returns to
  double ground_msl = 0;       ///< below it [m]
  std::string not_ready;       ///< why it cannot arm, for people; empty: it can
  bool paused = false;         ///< the simulation stands still
};

/// Whose autopilot a simulated vehicle resembles.
enum class Make : std::uint8_t { kArduPilot, kPx4 };

struct VehicleServerOptions {
  std::uint8_t system = 1;     ///< 1 to 250
  std::uint8_t component = 1;  ///< 1: an autopilot
  Make make = Make::kArduPilot;
  bool hovers = false;  ///< a multirotor; else a fixed wing
  FlightLimits limits;
  std::string name = "vehicle";  ///< for people: "kestrel-3"
  std::string software;          ///< for people: "Skein 0.1.0"
  /// Serial numbers follow from these two: the same in each run of a scenario.
  std::uint64_t seed = 0;
  std::uint32_t index = 0;
  std::int64_t start_unix_us = 0;  ///< UTC of the run's begin, since 1970
  double loiter_radius = 0;        ///< [m]; 0: limits.turn_radius
  double take_off_height = 50;     ///< above home, where none is given [m]
  double low_charge = 0.25;        ///< of the battery, from 0 to 1: shown as low
  double critical_charge = 0.1;    ///< shown as critical
  /// Ground stations may set home: whoever runs the vehicle takes it (take_home) and
  /// shows it in snapshots. Else they are refused.
  bool home_can_be_set = false;
  /// Further ones, after those that the make has: facts about the vehicle, for people.
  std::vector<Parameter> parameters;
};

/// The fence as ground stations set it up.
struct Fence {
  bool enabled = false;
  std::vector<Zone> inclusion;  ///< areas to stay in: inside of one is enough
  std::vector<Zone> exclusion;  ///< areas to stay out of
  std::uint32_t version = 0;    ///< counts changes
};

}  // namespace skein::vehicle_services
