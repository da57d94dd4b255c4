// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "skein/data/vehicle/flight_plan.h"
#include "skein/model/connection/connection.h"

namespace skein::model {

/// How fast an airplane changes its altitude while it flies with its horizontal airspeed.
struct ClimbLimits {
  double climb_rate = 3;  ///< largest [m/s], above 0
  double sink_rate = 3;   ///< largest [m/s], above 0
  /// Largest change of the climb rate [m/s^2]; 0: it changes at once.
  double acceleration = 0;
};

/// How the altitude decides about a connection in space ([Chitsaz07]).
enum class AltitudeCase : std::uint8_t {
  kLow,     ///< the shortest path over ground is long enough to change altitude on
  kMedium,  ///< it is lengthened by less than a circle
  kHigh,    ///< whole circles, helices in space, come before it
};

/// A flight between two states in space.
struct SpaceConnection {
  ConnectionStatus status = ConnectionStatus::kBadInput;
  AltitudeCase altitude = AltitudeCase::kLow;
  FlightPlan plan;  ///< starts at time 0 where the start is; empty when already there
  double time = 0;  ///< [s]; infinite unless found
};

/// The quickest connection of the horizontal `connect` that has time to climb or sink:
/// with constant horizontal airspeed and an even climb rate throughout, which with a
/// bounded acceleration begins and ends by vertical turns (climb_profile.h). When the
/// altitude takes longer than the path, the path is lengthened to just that time
/// (connect_at); where that cannot be flown exactly, to the next time found that can: a
/// time that could be met only within less than a sixteenth of a circle may be passed
/// over.
///
/// @param from, to  headings are of the air-relative velocity.
/// Fails:    kBadInput also for rates that are not above 0, an acceleration below 0 and
///           flights of more than 1e8 turn radii.
/// Valid:    the wind is horizontal and the same at all altitudes; the climb does not
///           slow the horizontal motion (at 10 degrees it would by 1.5 %).
/// Reference: [Chitsaz07].
SpaceConnection connect(const FlightState& from, const FlightState& to,
                        const AirMotion& air, const ClimbLimits& limits);

}  // namespace skein::model
