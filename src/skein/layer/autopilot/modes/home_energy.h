// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/geo/vec.h"

namespace skein::autopilot {

/// How the vehicle flies home. Powers in any unit, all in the same: in watts the energy
/// comes in joules; in charge per second, as counted by the battery monitor, in charge.
struct HomeFlight {
  double airspeed = 0;      ///< en route [m/s]
  double climb_rate = 1;    ///< [m/s], above 0
  double sink_rate = 1;     ///< [m/s], above 0
  double power_level = 0;   ///< in level flight at `airspeed`
  double power_climb = 0;   ///< at `climb_rate`
  double power_sink = 0;    ///< at `sink_rate`
  double landing_time = 0;  ///< approach and touchdown, at level power [s]
};

struct HomeNeed {
  double time = 0;    ///< [s]
  double energy = 0;  ///< power times seconds, see HomeFlight
};

/// Ground speed along a straight line in wind, the nose turned into it.
///
///   V_g = w_t + sqrt(V^2 - w_n^2),   w_t = wind . d,   w_n = wind x d
///
/// @param direction  unit vector of the line.
/// @returns  [m/s]; 0 when the vehicle cannot make headway along the line.
double ground_speed_along(const Vec2& direction, double airspeed, const Vec2& wind);

/// What it takes to fly home and land:
///
///   t_d = d / V_g                                    en route, level
///   t_h = h / sink_rate (h > 0), -h / climb_rate     above or below home
///   E   = P_level (t_d + t_landing) + P_sink t_h or P_climb t_h
///
/// Height is changed over home, not en route: what that would save is left as reserve.
///
/// @param to_home  from the vehicle to home, horizontal [m].
/// @param height   of the vehicle above home [m].
/// @param wind     [m/s], taken as constant.
/// @returns  infinite time and energy when the wind does not let the vehicle get there.
/// Valid:    steady wind and power; the turn towards home is left out.
HomeNeed home_need(const Vec2& to_home, double height, const Vec2& wind,
                   const HomeFlight& flight);

}  // namespace skein::autopilot
