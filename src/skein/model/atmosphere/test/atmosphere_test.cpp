// SPDX-License-Identifier: Apache-2.0
#include "skein/model/atmosphere/atmosphere.h"

#include <gtest/gtest.h>

#include <cmath>

#include "skein/data/vehicle/air.h"

namespace skein::model::atmosphere_test {
namespace {

TEST(Atmosphere, MatchesTheStandardsTable) {
  // Geometric altitude [m], T [K], p [Pa], density [kg/m^3]; the last two stand at 11 and
  // 20 km geopotential. Printed to five or six digits.
  const double rows[][4] = {
      {0, 288.150, 1.01325e5, 1.2250},         {1000, 281.651, 8.9876e4, 1.1117},
      {5000, 255.676, 5.4048e4, 7.3643e-1},    {10000, 223.252, 2.6500e4, 4.1351e-1},
      {11019.07, 216.650, 22632.06, 0.363918}, {20063.12, 216.650, 5474.889, 0.0880349}};
  for (const auto& [altitude, temperature, pressure, density] : rows) {
    const StandardAir air = standard_air(altitude);
    EXPECT_NEAR(air.temperature, temperature, 6e-4) << altitude;
    EXPECT_NEAR(air.pressure / pressure, 1, 5e-5) << altitude;
    EXPECT_NEAR(air.density / density, 1, 5e-5) << altitude;
  }
}

TEST(Atmosphere, PressureCarriesTheAirAbove) {
  // dp/dh = -rho g, with g of the geopotential, on both sides of the tropopause.
  for (const double h : {-2000.0, 0.0, 500.0, 9000.0, 12000.0, 18000.0}) {
    const double dh = 0.5;
    const double slope =
        (standard_air(h + dh).pressure - standard_air(h - dh).pressure) / (2 * dh);
    const double g = kGravity * std::pow(6356766 / (6356766 + h), 2);
    // The difference quotient cancels to 1e-11 of the pressure.
    EXPECT_NEAR(slope / (-standard_air(h).density * g), 1, 1e-6) << h;
  }
}

TEST(Atmosphere, DensityAroundAnAltitudeIsGoodToTheThirdOrder) {
  for (const double h : {-100.0, 300.0, 3000.0, 10500.0, 15000.0}) {
    const DensityAround around = density_around(h);
    EXPECT_EQ(around.density, standard_air(h).density);
    for (const double dh : {-50.0, -5.0, -0.5, 0.5, 5.0, 50.0}) {
      const double exact = standard_air(h + dh).density;
      // Below the tropopause n (n-1) (n-2) / 6 (L/T)^3 dh^3 is under (dh/19 km)^3, above
      // 1/6 (dh / 6.3 km)^3 under (dh / 11 km)^3; then rounding.
      const double length = h > 11000 ? 11e3 : 19e3;
      EXPECT_NEAR(around.at(dh) / exact, 1, std::pow(std::abs(dh) / length, 3) + 4e-16)
          << h << " " << dh;
    }
  }
}

TEST(Atmosphere, AltitudeOfADensityIsTheInverse) {
  // 1 mm: the two formulas round differently, no more.
  for (const double altitude : {-4000.0, 0.0, 3000.0, 10900.0, 11100.0, 25000.0})
    EXPECT_NEAR(standard_altitude(standard_air(altitude).density), altitude, 1e-3);
}

TEST(Atmosphere, StaysFiniteAnywhere) {
  for (const double h : {-1e6, -5001.0, 3e4, 1e6, 1e9}) {
    const DensityAround around = density_around(h);
    EXPECT_TRUE(std::isfinite(around.at(1))) << h;
    EXPECT_GE(around.density, 0) << h;
  }
}

}  // namespace
}  // namespace skein::model::atmosphere_test
