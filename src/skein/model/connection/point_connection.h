// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "skein/data/vehicle/flight_plan.h"
#include "skein/model/connection/connection.h"

namespace skein::model {

/// The quickest flight to a point, with any heading there: a turn and a straight, or a
/// turn and an opposite turn.
struct PointConnection {
  ConnectionStatus status = ConnectionStatus::kBadInput;
  bool right = true;     ///< the first turn
  bool straight = true;  ///< the second part; otherwise the opposite turn
  /// Turned angles [rad], the straight's length in turn radii.
  std::array<double, 2> parts{};
  double time = 0;  ///< [s]; infinite unless found
};

/// The earliest time at which one of the words LS, RS, LR, RL meets a point in a constant
/// wind, each solved on its own: see `connect`. LS and RS are exact. LR and RL matter
/// only while the point is near the turning circles; there meetings are looked for at 64
/// moments of its path past each, and two within one such step may be missed.
///
/// @param from   position over ground and *heading* of the air-relative velocity.
/// @param point  over ground [m].
/// Cost:     no allocation.
/// Reference: docs/connection.md.
PointConnection connect_to_point(const Pose& from, const Vec2& point,
                                 const AirMotion& air);

/// The connection as elements that begin at `from`, at a time and altitude.
/// @param start   time [s].
/// @param down    p_N.z() of the whole flight [m].
FlightPlan to_flight_plan(const PointConnection& connection, const Pose& from,
                          const AirMotion& air, double start = 0, double down = 0);

}  // namespace skein::model
