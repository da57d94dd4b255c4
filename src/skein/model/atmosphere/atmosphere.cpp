// SPDX-License-Identifier: Apache-2.0
#include "skein/model/atmosphere/atmosphere.h"

#include <algorithm>

#include "skein/base/math.h"
#include "skein/data/vehicle/air.h"

namespace skein::model {
namespace {

constexpr double kEarthRadius = 6356766;    // of the geopotential [m]
constexpr double kGasConstant = 287.05287;  // of air [J/(kg K)]
constexpr double kLapse = 0.0065;           // [K/m]
constexpr double kSeaLevelTemperature = 288.15;
constexpr double kSeaLevelPressure = 101325;
constexpr double kTropopause = 11000;  // geopotential [m]
constexpr double kLowest = -5000;      // [m]
constexpr double kExponent = kGravity / (kGasConstant * kLapse);

constexpr double kTropopauseTemperature = kSeaLevelTemperature - kLapse * kTropopause;

double geopotential(double altitude) {
  return kEarthRadius * altitude / (kEarthRadius + altitude);
}

}  // namespace

StandardAir standard_air(double altitude_msl) {
  const double H = geopotential(std::max(altitude_msl, kLowest));
  StandardAir air;
  if (H <= kTropopause) {
    air.temperature = kSeaLevelTemperature - kLapse * H;
    air.pressure =
        kSeaLevelPressure * math::pow(air.temperature / kSeaLevelTemperature, kExponent);
  } else {
    air.temperature = kTropopauseTemperature;
    air.pressure = kSeaLevelPressure *
                   math::pow(kTropopauseTemperature / kSeaLevelTemperature, kExponent) *
                   math::exp(-kGravity * (H - kTropopause) /
                             (kGasConstant * kTropopauseTemperature));
  }
  air.density = air.pressure / (kGasConstant * air.temperature);
  return air;
}

double standard_altitude(double density) {
  const double tropopause_density =
      kSeaLevelPressure *
      math::pow(kTropopauseTemperature / kSeaLevelTemperature, kExponent) /
      (kGasConstant * kTropopauseTemperature);
  double H = 0;
  if (density > tropopause_density) {
    const double sea_level = kSeaLevelPressure / (kGasConstant * kSeaLevelTemperature);
    H = kSeaLevelTemperature / kLapse *
        (1 - math::pow(density / sea_level, 1 / (kExponent - 1)));
  } else {
    H = kTropopause + kGasConstant * kTropopauseTemperature / kGravity *
                          math::log(tropopause_density / density);
  }
  return kEarthRadius * H / (kEarthRadius - H);
}

DensityAround density_around(double altitude_msl) {
  const StandardAir air = standard_air(altitude_msl);
  DensityAround around{air.density, 0, 0};
  if (altitude_msl < kLowest) return around;
  const double share = kEarthRadius / (kEarthRadius + altitude_msl);
  const double dH = share * share;                             // dH/dh
  const double ddH = -2 * dH / (kEarthRadius + altitude_msl);  // d2H/dh2
  if (air.temperature > kTropopauseTemperature) {
    // rho ~ T^n, T falls by kLapse dH.
    const double n = kExponent - 1, cooling = -kLapse / air.temperature;
    around.slope = n * cooling * dH;
    around.bend = 0.5 * n * cooling * ((n - 1) * cooling * dH * dH + ddH);
  } else {
    const double k = -kGravity / (kGasConstant * kTropopauseTemperature);
    around.slope = k * dH;
    around.bend = 0.5 * k * (k * dH * dH + ddH);
  }
  return around;
}

}  // namespace skein::model
