// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/assemble/kinds/contexts.h"
#include "skein/assemble/kinds/kinds.h"

namespace skein {
class Agent;
class Autopilot;
class MonitoringStrategy;
class MovingObject;
class PerimeterEstimator;
class Phenomenon;
class Plant;
class Radio;
class Routing;
class Sensor;
class Terrain;
class TrafficAircraft;
class Turbulence;
class Vehicle;
class WindField;
}  // namespace skein
namespace skein::reasoning {
struct PlannedMission;
}

namespace skein::assemble {

struct VehicleContext;

/// Strategies need nothing besides their options.
struct StrategyContext {};

// The table of kinds: every implementation that a scenario can name, one row each.
Kinds<Terrain, EnvironmentContext> terrain_kinds();
Kinds<WindField, EnvironmentContext> wind_kinds();
Kinds<Phenomenon, EnvironmentContext> phenomenon_kinds();
Kinds<MovingObject, ObjectContext> movement_kinds();
Kinds<TrafficAircraft, TrafficContext> traffic_kinds();
Kinds<Plant, AircraftContext> plant_kinds();
Kinds<Autopilot, AircraftContext> autopilot_kinds();
Kinds<Sensor, AircraftContext> sensor_kinds();
Kinds<Agent, AircraftContext> agent_kinds();
Kinds<Turbulence, AircraftContext> turbulence_kinds();
Kinds<Vehicle, VehicleContext> vehicle_kinds();
Kinds<reasoning::PlannedMission, MissionContext> mission_kinds();
Kinds<Radio, RadioContext> radio_kinds();
Kinds<Routing, RoutingContext> routing_kinds();
Kinds<PerimeterEstimator, EstimatorContext> estimator_kinds();
Kinds<MonitoringStrategy, StrategyContext> strategy_kinds();

/// Whether a vehicle's plant is a model, here or in an outside flight model, wherever its
/// autopilot is.
bool plant_is_simulated(const scenario::Choice& vehicle);

/// All of them, as scenarios are read with.
scenario::KindTable kind_table();

}  // namespace skein::assemble
