// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "skein/base/id.h"
#include "skein/data/perimeter/fire.h"
#include "skein/data/vehicle/airframe.h"
#include "skein/data/vehicle/vehicle.h"

namespace skein {
class Agent;
class Antenna;
class Autopilot;
class ErrorModel;
class MonitoringStrategy;
class MovingObject;
class PathPlanner;
class PerimeterEstimator;
class Phenomenon;
class Plant;
class Propagation;
class Radio;
class Routing;
class Sensor;
class Terrain;
class TrafficAircraft;
class Turbulence;
class Vehicle;
class WindField;
}  // namespace skein

/// What every implementation of a role owes to whoever uses it, as far as a test can see
/// it from outside. One function for each role; conditions are drawn at random from fixed
/// seeds. `skein list --verify` puts all kinds through them, those of plugins too.
namespace skein::contract {

/// How an implementation breaks its contract, one sentence each; empty: not found to.
using Violations = std::vector<std::string>;

/// Makes one more of the same kind, with the same options and seed.
template <class Role>
using Make = std::function<std::unique_ptr<Role>()>;

/// Finite everywhere, the same whenever asked, the gradient that of the heights.
Violations terrain_violations(const Make<Terrain>& make);

/// Finite everywhere and at all times, the same whenever asked.
Violations wind_violations(const Make<WindField>& make);

/// What burns keeps burning; inside() and region() agree; equal ones burn alike, in
/// steps of any number that lead to the same times.
Violations phenomenon_violations(const Make<Phenomenon>& make);

/// Its place is finite and goes on as its velocity says, within what a step may change;
/// equal ones that see the same aircraft move alike.
Violations moving_object_violations(const Make<MovingObject>& make);

/// Finite; while it is there its place goes on as its velocity says, within what a step
/// may change, but for jumps that it says; equal ones that see the same aircraft fly
/// alike.
Violations traffic_violations(const Make<TrafficAircraft>& make);

/// Finite gusts, the same for equal ones.
Violations turbulence_violations(const Make<Turbulence>& make);

/// Starts at the given state; stays finite under any control; remembers nothing but the
/// state; limits in order; on the ground after it has touched.
Violations plant_violations(const Make<Plant>& make);

/// Controls are finite, in range and what the airframe takes, with samples of any kind
/// and with none; begins at the given state; equal ones fly alike.
/// @param airframe, limits  of the plant that it was made for.
Violations autopilot_violations(const Make<Autopilot>& make, const Airframe& airframe,
                                const FlightLimits& limits);

/// Only appends; times of samples neither in the future nor going back; finite; equal
/// ones say the same; one that serves the autopilot never looks at the fire.
Violations sensor_violations(const Make<Sensor>& make);

/// The estimate is finite, not of the future and never older than before; each command is
/// answered, what cannot be flown with a reason; the truth is known always or never;
/// events are given once; equal ones fly alike.
/// @param wind  that it flies in.
Violations vehicle_violations(const Make<Vehicle>& make, const WindField& wind);

/// Plans lead from start to goal, join, turn no tighter than the aircraft can and keep
/// out of zones; outcome, duration and bound agree with them; what cannot be planned is
/// said; equal ones plan alike.
Violations planner_violations(const Make<PathPlanner>& make);

/// Every message arrives or is lost once, unchanged, not before it was sent; equal ones
/// treat the same messages alike.
/// @param entities  that have a place, two at least.
Violations radio_violations(const Make<Radio>& make, std::span<const EntityId> entities);

inline constexpr std::size_t kRoutingEntities = 7;

/// Between radios in a row, in a ring and where all hear all: messages are sent to their
/// receiver, to all, or by way of somebody whom the sender hears; a receiver that its
/// sender hears is reached; waits are finite; equal ones decide alike.
/// @param make  of kRoutingEntities.
Violations routing_violations(const Make<Routing>& make);

/// Not less than nothing and not more than was sent, the same in both directions and
/// whenever asked, also for one place twice; equal ones say the same.
Violations propagation_violations(const Make<Propagation>& make);

/// A finite gain in every direction; equal ones say the same.
Violations antenna_violations(const Make<Antenna>& make);

/// Finite logarithms of probabilities, never falling with the ratio; parts of a frame
/// make the whole; equal ones say the same.
Violations error_model_violations(const Make<ErrorModel>& make);

/// Only appends; commands and messages are finite, whatever is received; equal ones act
/// alike.
/// @param nav  of its vehicle at the start; null: it has none.
Violations agent_violations(const Make<Agent>& make, const NavEstimate* nav);

/// A boundary of the time that was asked for, finite, with unit normals; clones are equal
/// and independent; impossible observations do no lasting harm; equal ones believe alike.
/// @param prior  that it was made with.
Violations estimator_violations(const Make<PerimeterEstimator>& make,
                                const PerimeterPrior& prior);

/// Orders for aircraft of the situation only, at most one each and in their order, no two
/// to the same point; equal ones order alike.
Violations strategy_violations(const Make<MonitoringStrategy>& make);

}  // namespace skein::contract
