// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "skein/geo/vec.h"

namespace skein::autopilot_client {

/// How well a vehicle knows where it is, as it says.
struct PositionQuality {
  bool receiver = false;               ///< GPS_RAW_INT comes
  int fix = 0;                         ///< GPS_FIX_TYPE
  std::optional<int> satellites = {};  ///< none: it does not say
  std::optional<double> hdop = {};     ///< horizontal dilution of precision
  std::optional<double> sd = {};       ///< of the receiver's position, as it says [m]
  std::optional<std::uint16_t> estimator = {};  ///< flags of EKF_STATUS_REPORT or
                                                ///< ESTIMATOR_STATUS
};

/// Whether it knows where it is: by its receiver's fix, or, where it has no receiver, as
/// with indoor positioning, by what its estimator says.
bool knows_position(const PositionQuality& quality);

/// Where a vehicle is to be before it is first commanded.
struct StartArea {
  Vec3 p_N = Vec3::Zero();       ///< where the scenario has it [m]
  double max_distance = 500;     ///< from there, on the map [m]
  double max_height_error = 30;  ///< the same, of the altitude, on the ground [m]
};

/// What is known of a vehicle that is to take off.
struct PreflightInputs {
  std::uint8_t type = 0;  ///< MAV_TYPE
  bool hovers = false;    ///< what it must be
  std::optional<StartArea> start = {};
  PositionQuality quality = {};
  bool origin = false;                ///< positions are about 0, 0
  std::optional<Vec3> position = {};  ///< the last [m]
  double position_age = 0;            ///< when it came in, by the aligned clock [s]
  double position_rate = 0;           ///< of positions [Hz]
  double since_position = 0;          ///< since one came in, by the clock here [s]
  double since_jump = 1e9;            ///< since its position jumped [s]
  double since_clock = 1e9;           ///< since its clock was set [s]
  std::optional<Vec3> home = {};      ///< [m]
  double since_heartbeat = 0;         ///< [s]
  double round_trip = 0;              ///< [s]; 0: not measured
  std::optional<double> charge = {};  ///< from 0 to 1; none: it does not say
  bool emergency = false;             ///< as it says of itself
};

/// What of the list fails, each as "position: it has no fix (GPS_FIX_TYPE 1)". Empty: it
/// may take off.
///
/// identity, health, clock, position, place, home, telemetry, link, energy
struct PreflightResult {
  std::uint32_t failed = 0;  ///< bit k: item k of the list
  std::string text;          ///< all that fail, separated by semicolons
};
PreflightResult check_preflight(const PreflightInputs& in);

/// How far a vehicle is from where it may be commanded first, as a text with what is
/// allowed and the key; empty: it is near enough.
/// @param on_ground  its altitude counts too; in flight, as when a run begins again, ten
///                   times the distance is allowed.
std::string misplaced(const Vec3& p_N, const StartArea& start, bool on_ground);

}  // namespace skein::autopilot_client
