// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "skein/layer/reasoning/trajectory/detour_planner.h"

namespace skein::reasoning {

/// What flights of a team meet, as who shares its tasks believes: the wind, and no-fly
/// zones that they lead around.
class FlightConditions {
 public:
  void set_wind(const Vec2& wind) { wind_ = wind; }
  /// [m/s]
  const Vec2& wind() const { return wind_; }

  /// @param zones         in force.
  /// @param altitude_msl  of the team's flights [m]: zones far over or under it do not
  ///                      count.
  /// @param time          [s], as the zones have it.
  void set_zones(std::span<const Zone> zones, double altitude_msl, double time);

  /// Time of the shortest way by straight legs around the zones that count:
  ///
  ///   sum over its legs of leg / (w_along + sqrt(V^2 - w_across^2))
  ///
  /// @param speed  through the air [m/s].
  /// @returns  [s]; none: a leg cannot be flown against the wind.
  std::optional<double> time(const Vec2& from, const Vec2& to, double speed) const;

 private:
  Vec2 wind_ = Vec2::Zero();
  std::vector<Zone> zones_;               // that count
  std::optional<DetourPlanner> detours_;  // around them; none: there are none
};

/// Time of a straight flight in wind; see FlightConditions::time().
/// @returns  [s]; none: it does not get there against the wind.
std::optional<double> time_in_wind(const Vec2& leg, double speed, const Vec2& wind);

}  // namespace skein::reasoning
