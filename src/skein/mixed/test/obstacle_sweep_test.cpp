// SPDX-License-Identifier: Apache-2.0
#include "skein/mixed/obstacle_sweep.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "skein/base/math.h"
#include "skein/base/random.h"

namespace skein::mixed::obstacle_sweep_test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Waves in both directions, wider than the samples are apart.
class Waves final : public Terrain {
 public:
  Waves(double length, double phase) : k_(2 * geo::kPi / length), phase_(phase) {}
  double elevation_msl(const Vec2& p) const override {
    return 100 + 30 * math::sin(k_ * p.x() + phase_) * math::cos(k_ * p.y());
  }
  Vec2 gradient(const Vec2&) const override { return Vec2::Zero(); }

 private:
  double k_, phase_;
};

class Plain final : public Terrain {
 public:
  double elevation_msl(const Vec2&) const override { return 0; }
  Vec2 gradient(const Vec2&) const override { return Vec2::Zero(); }
};

// The first sample, each 5 cm, that is in the ground or in a zone.
double march(const Terrain& terrain, std::span<const Zone> zones, const Vec3& p_N,
             double bearing, double now, double range) {
  constexpr double kStep = 0.05;
  for (double d = 0; d <= range; d += kStep) {
    const Vec2 place = geo::horizontal(p_N) + d * geo::unit(bearing);
    if (terrain.elevation_msl(place) >= -p_N.z()) return d;
    for (const Zone& zone : zones)
      if (holds_at(zone, -p_N.z(), now) && covers(zone, place)) return d;
  }
  return kInfinity;
}

Zone random_zone(RandomStream& random) {
  const auto within = [&](double half) { return (2 * random.uniform() - 1) * half; };
  Zone zone;
  const Vec2 centre{within(200), within(200)};
  if (random.uniform() < 0.5) {
    zone.area = Disc{centre, 20 + 60 * random.uniform()};
  } else {
    geo::Ring ring;
    for (int k = 0; k < 5; ++k)
      ring.push_back(centre +
                     (20 + 60 * random.uniform()) * geo::unit(k * 2 * geo::kPi / 5));
    zone.area = made_positive(ring);
  }
  zone.floor_msl = within(200);
  zone.ceiling_msl = zone.floor_msl + 150;
  return zone;
}

TEST(ObstacleSweep, IsWhatAMarchInSmallStepsFinds) {
  RandomStream random(2018, 0, Purpose::kTest);
  int found = 0;
  for (int round = 0; round < 60; ++round) {
    const Waves terrain(80 + 200 * random.uniform(), 6 * random.uniform());
    const std::vector<Zone> zones = {random_zone(random), random_zone(random)};
    const Vec3 p_N{100 * random.uniform(), 100 * random.uniform(),
                   -(95 + 40 * random.uniform())};
    const double heading = 2 * geo::kPi * random.uniform();
    const ObstacleDistances seen = sweep(terrain, zones, p_N, heading, Time(), 150);
    for (std::size_t k = 0; k < seen.distances.size(); ++k) {
      const double bearing = heading + geo::radians(5.0 * static_cast<double>(k));
      const double slow = march(terrain, zones, p_N, bearing, 0, 150);
      // Where the ray grazes a crest both find it or neither is sure to: a chord through
      // it that is shorter than the samples' distance may be overlooked.
      if (seen.distances[k] == kInfinity && slow != kInfinity) {
        const Vec2 behind = geo::horizontal(p_N) + (slow + 2.5) * geo::unit(bearing);
        bool grazes = terrain.elevation_msl(behind) < -p_N.z();
        for (const Zone& zone : zones)
          grazes |= holds_at(zone, -p_N.z(), 0) && !covers(zone, behind);
        EXPECT_TRUE(grazes || slow > 149.9) << k << ": " << slow;
        continue;
      }
      if (slow == kInfinity) {
        EXPECT_GT(seen.distances[k], 149.9);  // the last sample of the march
        continue;
      }
      ++found;
      EXPECT_GE(seen.distances[k], slow - 0.1);
      if (seen.distances[k] > slow + 0.1) {
        const Vec2 behind = geo::horizontal(p_N) + (slow + 2.5) * geo::unit(bearing);
        EXPECT_LT(terrain.elevation_msl(behind), -p_N.z()) << "overlooked at " << slow;
      }
    }
  }
  EXPECT_GT(found, 1000);
}

TEST(ObstacleSweep, DirectionsCountFromTheNoseClockwise) {
  const Plain terrain;
  Zone east{.area = Disc{{0, 60}, 10}};
  const std::vector<Zone> zones = {east};
  const Vec3 p_N{0, 0, -50};
  const ObstacleDistances north = sweep(terrain, zones, p_N, 0, Time(), 100);
  EXPECT_NEAR(north.distances[18], 50, 1e-9);
  EXPECT_EQ(north.distances[0], kInfinity);
  EXPECT_EQ(north.distances[54], kInfinity);
  const ObstacleDistances ahead = sweep(terrain, zones, p_N, geo::kPi / 2, Time(), 100);
  EXPECT_NEAR(ahead.distances[0], 50, 1e-9);
}

TEST(ObstacleSweep, OnlyZonesInForceAtTheAltitudeAreWalls) {
  const Plain terrain;
  Zone zone{.area = Disc{{60, 0}, 10}};
  zone.ceiling_msl = 40;
  zone.from = 100;
  const std::vector<Zone> zones = {zone};
  const auto ahead = [&](double altitude, double time, double range) {
    return sweep(terrain, zones, {0, 0, -altitude}, 0, Time::from_seconds(time), range)
        .distances[0];
  };
  EXPECT_NEAR(ahead(30, 150, 100), 50, 1e-9);
  EXPECT_EQ(ahead(50, 150, 100), kInfinity);
  EXPECT_EQ(ahead(30, 50, 100), kInfinity);
  EXPECT_EQ(ahead(30, 150, 49), kInfinity);  // beyond the range
}

TEST(ObstacleSweep, InsideSomethingEverythingIsNear) {
  const Plain terrain;
  const std::vector<Zone> zones = {Zone{.area = Disc{{0, 0}, 10}}};
  for (const double d : sweep(terrain, zones, {0, 0, -50}, 0, Time(), 100).distances)
    EXPECT_EQ(d, 0);
  for (const double d : sweep(terrain, {}, {0, 0, 5}, 0, Time(), 100).distances)
    EXPECT_EQ(d, 0);
}

}  // namespace
}  // namespace skein::mixed::obstacle_sweep_test
