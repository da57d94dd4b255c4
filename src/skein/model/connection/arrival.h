// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "skein/data/vehicle/flight_plan.h"
#include "skein/model/connection/connection.h"

namespace skein::model {

/// How a timed connection ended.
enum class ArrivalStatus : std::uint8_t {
  kFound,
  /// Before the connection's time. Where that is irregular, a flight that is no Dubins
  /// word may be there by then.
  kTooEarly,
  kGap,  ///< between two lengths that can be flown; later times can be met
  /// See ConnectionStatus: wind too strong or bad input; or a time of more than 1e9 turn
  /// radii of flight.
  kNotConnected,
};

/// A flight that meets a pose at a time.
struct Arrival {
  ArrivalStatus status = ArrivalStatus::kNotConnected;
  FlightPlan plan;      ///< empty unless found
  double earliest = 0;  ///< the time of `connect` [s]
};

/// A flight from one pose to another that takes exactly `time`: the path is lengthened.
///
/// At that time the goal is at a fixed place of the air mass, and a path of one length to
/// it is sought. Whole circles are flown at the start. What remains is made by one
/// parameter: going on straight before the connection, coming in straight for longer, or
/// turning left or right first. Each such length grows continuously with its parameter
/// between the jumps of the shortest length, so that it is found by false position.
///
/// @param from, to  positions over ground and headings of the air-relative velocity.
/// @param time      of the flight [s].
/// @returns         a plan that starts at time 0 and altitude 0, at most eight elements;
///                  its end is off by at most 1e-9 turn radii.
/// Valid:           a gap that is reported may be narrower than it seems: a path of that
///                  length outside of the four families is not looked for.
Arrival connect_at(const Pose& from, const Pose& to, const AirMotion& air, double time);

}  // namespace skein::model
