// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace skein::model {

/// The International Standard Atmosphere: what air is like at an altitude above mean sea
/// level.
///
///   H = 6356766 h / (6356766 + h)                 geopotential altitude
///   T = 288.15 - 0.0065 H,  p = 101325 (T / 288.15)^(g0 / (0.0065 R))   below 11 km
///   T = 216.65,  p = p_11 exp(-g0 (H - 11000) / (R T))                  above
///   density = p / (R T),  R = 287.05287 J/(kg K)
///
/// @param altitude_msl  geometric, -5000 to 20000 [m]; beyond 20 km the air goes on as
///                      if isothermal, below -5 km it is that of -5 km.
/// Reference: [ISO2533] sections 2 and 4.
struct StandardAir {
  double temperature = 0;  ///< [K]
  double pressure = 0;     ///< [Pa]
  double density = 0;      ///< [kg/m^3]
};
StandardAir standard_air(double altitude_msl);

/// The altitude above mean sea level [m] where that air has a density [kg/m^3], above 0.
double standard_altitude(double density);

inline constexpr double kSeaLevelDensity = 1.225;  ///< rounded, as standards quote it

/// Density around one altitude, for the stages of an integration step: the exact one and
/// its first two derivatives there.
///
///   density(h0 + dh) = rho (1 + slope dh + bend dh^2)
///
/// Valid: the relative error is below (dh / 19 km)^3 in the troposphere: 2e-11 at
///        5 m, 2e-8 at 50 m.
struct DensityAround {
  double density = 0;  ///< at h0 [kg/m^3]
  double slope = 0;    ///< relative [1/m]
  double bend = 0;     ///< relative [1/m^2]

  double at(double dh) const { return density * (1 + dh * (slope + dh * bend)); }
};
DensityAround density_around(double altitude_msl);

}  // namespace skein::model
