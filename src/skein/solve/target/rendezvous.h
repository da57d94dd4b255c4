// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "skein/data/vehicle/flight_plan.h"
#include "skein/data/vehicle/vehicle.h"
#include "skein/role/path_planner.h"

namespace skein::solve {

/// Who shall be where.
struct RendezvousAircraft {
  FlightState start, goal;
  double start_time = 0;  ///< [s]
  FlightLimits limits;
};

struct RendezvousQuery {
  std::vector<RendezvousAircraft> aircraft;
  /// Arrival of the first one; none: as early as all can [s].
  std::optional<double> time = std::nullopt;
  /// Between arrivals [s]; 0: all at once. In a sequence who can be there first comes
  /// first.
  double spacing = 0;
  bool any_airspeed = true;  ///< from slowest to fastest; else cruise only
  Vec2 wind = Vec2::Zero();  ///< velocity of the air over ground [m/s]
};

enum class RendezvousOutcome : std::uint8_t {
  kPlanned,
  kTooEarly,     ///< see `earliest`
  kGap,          ///< somebody can be there before and after, but not then: see `earliest`
  kBadAircraft,  ///< somebody's limits or states are not numbers, or cannot climb or sink
  kBadQuery,     ///< nobody, a time or a spacing that is not allowed
  kWindTooStrong,  ///< for somebody's airspeeds
};

/// The word for an outcome, as files and messages have it.
std::string_view name_of(RendezvousOutcome outcome);

/// A rendezvous, planned.
struct RendezvousResult {
  RendezvousOutcome outcome = RendezvousOutcome::kBadQuery;
  std::string reason = {};        ///< for people; empty when planned
  std::vector<FlightPlan> plans;  ///< of each aircraft; empty unless planned
  std::vector<double> arrivals;   ///< of each [s]
  std::vector<double> airspeeds;  ///< of each [m/s]
  /// Planned or too early: the earliest time of the first arrival at which all can be as
  /// asked; in a gap, the next time that was found [s].
  double earliest = 0;
};

/// Plans flights that are at their goals at one time, or one after the other.
///
/// Each arrives exactly, by its airspeed as far as that goes, then by detours
/// (timed_flight.h). Goals and paths are not kept apart: give goals that are.
RendezvousResult plan_rendezvous(const RendezvousQuery& query);

}  // namespace skein::solve
