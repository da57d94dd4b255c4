// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "skein/data/vehicle/flight_plan.h"
#include "skein/model/path/dubins.h"
#include "skein/model/path/pose.h"

namespace skein::model {

/// How an aircraft moves through the air while it is connected.
struct AirMotion {
  double airspeed = 15;      ///< [m/s], above 0
  double turn_radius = 60;   ///< smallest, in the air mass [m], above 0
  Vec2 wind = Vec2::Zero();  ///< velocity of the air over ground [m/s]
};

/// How a connection ended.
enum class ConnectionStatus : std::uint8_t {
  kFound,
  kWindTooStrong,  ///< at or above the airspeed: places upwind cannot be reached
  /// Something is not finite, airspeed or radius are not above 0, or the goal is more
  /// than 1e9 turn radii away.
  kBadInput,
};

/// The word for a status, as files and messages have it.
std::string_view name_of(ConnectionStatus status);

/// The quickest flight of one Dubins word from one pose to another in a constant wind.
struct Connection {
  ConnectionStatus status = ConnectionStatus::kBadInput;
  DubinsWord word = DubinsWord::kLSL;
  /// The goal, which the wind carries towards or from the aircraft as seen from the air
  /// mass, comes within four turn radii of the start before it is met. Lengths of words
  /// jump there, and a flight that is no Dubins word may be quicker ([McGee05]).
  bool irregular = false;
  /// The three parts in turn radii: turned angles [rad] and the straight's length. Outer
  /// turns may be more than a full one.
  std::array<double, 3> parts{};
  double time = 0;  ///< [s]; infinite unless found
};

/// The earliest time at which one of the six Dubins words meets the goal:
///
///   T* = min { T >= 0 : L_word(q0, q1 - w T) = V T for one of the words }
///
/// Each word is solved on its own, outer turns of more than a full circle included, so
/// nothing is lost where lengths jump.
///
/// - LSL, RSR: V T - |D - w T| = rho (turned + 2 pi m), a quadratic in T.
/// - LSR, RSL: one monotone residual per m, solved by safeguarded Newton.
/// - LRL, RLR: |D - w T|^2 = 8 rho^2 (1 + cos((V T / rho - c) / 2)), both middle arcs in
///   one equation; between the inflection points of the difference Newton from the right
///   side finds each root.
///
/// @param from, to  positions over ground and *headings* of the air-relative velocity.
/// @returns  found whenever |wind| < airspeed, everything is finite and the goal is
///           within 1e9 turn radii (beyond, doubles do not distinguish places a turn
///           apart); the parts, flown, end at the goal to rounding.
/// Cost:     no allocation.
/// Reference: docs/connection.md (derivation); [McGee05].
Connection connect(const Pose& from, const Pose& to, const AirMotion& air);

/// The pose whose heading makes good the course of `over_ground` in the wind: connections
/// take headings, courses over ground go through here. Nothing when no heading gives that
/// course, which is never the case while |wind| < airspeed.
std::optional<Pose> heading_pose(const Pose& over_ground, const AirMotion& air);

/// Many connections in one wind model each; `out` has the size of `queries`.
struct ConnectionQuery {
  Pose from, to;
  AirMotion air;
};
void connect(std::span<const ConnectionQuery> queries, std::span<Connection> out);

/// The connection as elements that begin at `from`, at a time and altitude; parts without
/// length are left out.
/// @param start   time [s].
/// @param down    p_N.z() of the whole flight [m].
FlightPlan to_flight_plan(const Connection& connection, const Pose& from,
                          const AirMotion& air, double start = 0, double down = 0);

}  // namespace skein::model
