// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "skein/data/describe/describe.h"
#include "skein/geo/vec.h"

namespace skein {

/// Flown from moment to moment by a bank, for what holds its attitude by itself. Good for
/// a second.
struct BankSetpoint {
  double roll = 0;          ///< [rad]
  double altitude_msl = 0;  ///< to be at [m]
  double climb_rate = 0;    ///< on the way there [m/s], up positive
  double airspeed = 0;      ///< [m/s]
};

constexpr auto describe(const BankSetpoint*) {
  using T = BankSetpoint;
  return described<T>(
      {"bank_setpoint"}, "Flown from moment to moment by a bank.",
      field("roll", &T::roll, unit::kDegree, "right positive"),
      field("altitude_msl", &T::altitude_msl, unit::kMetre, "to be at"),
      field("climb_rate", &T::climb_rate, unit::kMetrePerSecond, "on the way there"),
      field("airspeed", &T::airspeed, unit::kMetrePerSecond, "to fly"));
}

/// Flown from moment to moment along a trajectory: where it is to be now, how fast, and
/// how that changes. Good for a second. A fixed wing flies the line through the point,
/// straight or bent as the acceleration says.
struct TrackSetpoint {
  Vec3 p_N = Vec3::Zero();                       ///< [m]
  Vec3 v_N = Vec3::Zero();                       ///< over ground [m/s]
  Vec3 a_N = Vec3::Zero();                       ///< [m/s^2]
  std::optional<double> heading = std::nullopt;  ///< [rad]; none: its own business
};

constexpr auto describe(const TrackSetpoint*) {
  using T = TrackSetpoint;
  return described<T>({"track_setpoint"}, "Flown from moment to moment along a line.",
                      field("", &T::p_N, axes::kPlace, "to be at now"),
                      field("", &T::v_N, axes::kVelocity, "over ground"),
                      field("acceleration", &T::a_N, axes::kOffset, "over ground"),
                      field("heading", &T::heading, unit::kDegree, "null: its own"));
}

}  // namespace skein
