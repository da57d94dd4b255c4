// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/communication/antenna/antenna_pattern.h"

#include <gtest/gtest.h>

#include <cmath>

#include "skein/base/random.h"

namespace skein::communication::antenna_pattern_test {
namespace {

// Direction in B by azimuth and elevation.
Vec3 towards(double azimuth_deg, double elevation_deg) {
  const double a = geo::radians(azimuth_deg), e = geo::radians(elevation_deg);
  return {std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), -std::sin(e)};
}

double gain_db(const Antenna& antenna, const Vec3& direction_B) {
  return 10 * std::log10(antenna.gain(direction_B));
}

TEST(Isotropic, IsNoPattern) {
  EXPECT_EQ(Isotropic().gain(towards(20, -70)), 1);
}

TEST(VerticalDipole, IsStrongestToTheSidesAndWeakestAlongItsRod) {
  const VerticalDipole antenna(-30);
  for (int azimuth = 0; azimuth < 360; azimuth += 45)
    EXPECT_NEAR(gain_db(antenna, towards(azimuth, 0)), 0, 1e-9);
  // The beam of a half-wave dipole is 78 degrees wide at -3 dB.
  EXPECT_NEAR(gain_db(antenna, towards(20, 39)), -3, 0.05);
  EXPECT_NEAR(gain_db(antenna, towards(20, -39)), -3, 0.05);
  EXPECT_NEAR(gain_db(antenna, {0, 0, 1}), -30, 1e-9);
  EXPECT_NEAR(gain_db(antenna, {0, 0, -1}), -30, 1e-9);
  double before = 1;
  for (int elevation = 0; elevation <= 90; ++elevation) {
    const double now = antenna.gain(towards(0, elevation));
    EXPECT_LE(now, before + 1e-12);  // roundings
    before = now;
  }
}

TEST(BodyShadow, CoversAConeWithASoftEdge) {
  AntennaProfile profile;
  profile.shadow_azimuth = geo::radians(180);
  profile.shadow_elevation = geo::radians(-10);
  profile.shadow_half_width = geo::radians(30);
  profile.shadow_edge = geo::radians(20);
  profile.shadow_depth_db = 18;
  const BodyShadow antenna(profile);
  // Tolerances: roundings, which grow where acos is steep.
  EXPECT_NEAR(gain_db(antenna, towards(180, -10)), -18, 1e-9);
  EXPECT_NEAR(gain_db(antenna, towards(180, 9)), -18, 1e-9);
  EXPECT_NEAR(gain_db(antenna, towards(180, 20)), -9, 1e-6);
  EXPECT_NEAR(gain_db(antenna, towards(180, -40)), -9, 1e-6);
  EXPECT_EQ(antenna.gain(towards(180, 31)), 1);
  EXPECT_EQ(antenna.gain(towards(0, 0)), 1);
  double before = -18;
  for (double elevation = -10; elevation < 60; elevation += 0.25) {
    const double now = gain_db(antenna, towards(180, elevation));
    EXPECT_GE(now, before - 1e-9);
    EXPECT_LT(now - before, 1);  // no step: at most pi/2 18 dB / 20 degrees / 4
    before = now;
  }
}

TEST(GainTable, GivesItsEntriesAndIsSmoothInBetween) {
  AntennaProfile profile;
  for (const double azimuth : {10.0, 100.0, 190.0, 280.0})
    profile.azimuths.push_back(geo::radians(azimuth));
  for (const double elevation : {-30.0, 30.0})
    profile.elevations.push_back(geo::radians(elevation));
  profile.gains_db = {{0, -4, -20, -8}, {2, -2, -10, -2}};
  const GainTable antenna(profile);
  // Tolerances: roundings of angles.
  EXPECT_NEAR(gain_db(antenna, towards(190, -30)), -20, 1e-9);
  EXPECT_NEAR(gain_db(antenna, towards(190, 0)), -15, 1e-9);
  EXPECT_NEAR(gain_db(antenna, towards(145, 30)), -6, 1e-9);
  EXPECT_NEAR(gain_db(antenna, towards(100, 80)), -2, 1e-9);  // the nearest row
  EXPECT_NEAR(gain_db(antenna, towards(100, -80)), -4, 1e-9);
  // Round north: from 280 to 370 degrees.
  EXPECT_NEAR(gain_db(antenna, towards(325, -30)), -4, 1e-9);
  EXPECT_NEAR(gain_db(antenna, towards(0, -30)), -8 + 8 * 80.0 / 90, 1e-9);
  EXPECT_NEAR(gain_db(antenna, towards(9.999, -30)), 0, 1e-2);
}

TEST(GainTable, OfOneEntryIsTheSameEverywhere) {
  AntennaProfile profile;
  profile.azimuths = {geo::radians(90)};
  profile.elevations = {0};
  profile.gains_db = {{-3}};
  const GainTable antenna(profile);
  RandomStream random(3, 0, Purpose::kTest);
  for (int i = 0; i < 1000; ++i) {
    const double gain =
        antenna.gain(towards(random.uniform(-180, 540), random.uniform(-90, 90)));
    EXPECT_NEAR(10 * std::log10(gain), -3, 1e-12);
  }
}

}  // namespace
}  // namespace skein::communication::antenna_pattern_test
