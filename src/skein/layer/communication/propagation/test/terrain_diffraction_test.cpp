// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/communication/propagation/terrain_diffraction.h"

#include <gtest/gtest.h>

#include <cmath>

#include "skein/base/random.h"
#include "skein/layer/communication/propagation/knife_edge.h"
#include "skein/layer/communication/propagation/path_loss.h"

namespace skein::communication::terrain_diffraction_test {
namespace {

constexpr double kFrequency = 2.4e9;
constexpr double kWavelength = 299'792'458 / kFrequency;

// A wall across north, as thin as the distance of samples, on ground far below.
class Wall : public Terrain {
 public:
  Wall(double north, double height) : north_(north), height_(height) {}
  double elevation_msl(const Vec2& p) const override {
    ++looks;
    return std::abs(p.x() - north_) < 5 ? height_ : -1000;
  }
  Vec2 gradient(const Vec2&) const override { return Vec2::Zero(); }
  mutable int looks = 0;

 private:
  double north_, height_;
};

// The same, whose greatest height is known.
class KnownWall final : public Wall {
 public:
  KnownWall(double north, double height) : Wall(north, height), height_(height) {}
  double highest_msl() const override { return height_; }

 private:
  double height_;
};

class Hills final : public Terrain {
 public:
  double elevation_msl(const Vec2& p) const override {
    return 60 * std::sin(p.x() / 300) * std::cos(p.y() / 400);
  }
  Vec2 gradient(const Vec2&) const override { return Vec2::Zero(); }
};

TerrainDiffraction over(const Terrain& terrain) {
  return {std::make_unique<FreeSpace>(kFrequency), terrain, kFrequency, 20};
}

TEST(KnifeEdge, LosesWhatP526Says) {
  // The curve of the recommendation, read to 0.1 dB.
  EXPECT_NEAR(knife_edge_loss_db(0), 6.0, 0.1);
  EXPECT_NEAR(knife_edge_loss_db(1), 13.9, 0.1);
  EXPECT_NEAR(knife_edge_loss_db(2.4), 20.5, 0.2);
  EXPECT_NEAR(knife_edge_loss_db(-0.779), 0, 0.05);
  EXPECT_EQ(knife_edge_loss_db(-0.78), 0);
  EXPECT_EQ(knife_edge_loss_db(-10), 0);
}

TEST(KnifeEdge, AgreesWithFresnelsIntegral) {
  // |(1 + i)/2 times the integral of exp(-i pi t^2 / 2) from v on|, [P526] Eq. (30).
  // The recommendation's approximation is good to 0.3 dB over these.
  for (const double v : {-0.7, -0.3, 0.0, 0.5, 1.0, 2.0}) {
    double c = 0, s = 0;
    constexpr double kStep = 1e-4;
    for (double t = kStep / 2; t < std::abs(v); t += kStep) {
      c += kStep * std::cos(geo::kPi / 2 * t * t);
      s += kStep * std::sin(geo::kPi / 2 * t * t);
    }
    if (v < 0) c = -c, s = -s;
    const double field = std::sqrt(std::pow(1 - c - s, 2) + std::pow(c - s, 2)) / 2;
    EXPECT_NEAR(knife_edge_loss_db(v), -20 * std::log10(field), 0.3) << v;
  }
}

TEST(TerrainDiffraction, OfASingleEdgeIsThatOfTheFormula) {
  const double bulge = 500.0 * 500 / (2 * 4.0 / 3 * 6'371e3);  // 15 mm
  for (const double height : {-3.0, 0.0, 5.0, 40.0}) {
    const Wall wall(500, height);
    const double v = fresnel_parameter(height + bulge, 500, 500, kWavelength);
    // Only roundings differ: ends, edge and samples lie at whole metres.
    EXPECT_NEAR(over(wall).loss_db({0, 0, 0}, {1000, 0, 0}), knife_edge_loss_db(v), 1e-9)
        << height;
  }
}

TEST(TerrainDiffraction, OfTwoEqualEdgesIsDeygouts) {
  // Both at a third: one is the main edge, the other stands on the rest of the path.
  class TwoWalls final : public Terrain {
   public:
    double elevation_msl(const Vec2& p) const override {
      return std::abs(p.x() - 600) < 5 || std::abs(p.x() - 1200) < 5 ? 20 : -1000;
    }
    Vec2 gradient(const Vec2&) const override { return Vec2::Zero(); }
  } walls;
  TerrainDiffraction field(std::make_unique<FreeSpace>(kFrequency), walls, kFrequency,
                           30);
  const double main = knife_edge_loss_db(fresnel_parameter(20, 600, 1200, kWavelength));
  const double minor = knife_edge_loss_db(fresnel_parameter(10, 600, 600, kWavelength));
  // The earth's bulge of up to 4 cm is not in what is expected.
  EXPECT_NEAR(field.loss_db({0, 0, 0}, {1800, 0, 0}),
              main + (1 - std::exp(-main / 6)) * minor, 0.1);
}

TEST(TerrainDiffraction, GrowsWithTheHeightOfTheRidge) {
  double before = -1;
  for (double height = -20; height <= 100; height += 0.5) {
    const Wall wall(300, height);
    const double loss = over(wall).loss_db({0, 0, -2}, {1000, 0, -10});
    EXPECT_GE(loss, before) << height;
    before = loss;
  }
  EXPECT_GT(before, 30);
  const Wall low(300, -20);
  EXPECT_EQ(over(low).loss_db({0, 0, -2}, {1000, 0, -10}), 0);
}

TEST(TerrainDiffraction, IsTheSameInBothDirections) {
  const Hills hills;
  const TerrainDiffraction field = over(hills);
  RandomStream random(2, 0, Purpose::kTest);
  int lossy = 0;
  for (int i = 0; i < 2000; ++i) {
    const auto place = [&] {
      const Vec2 p(random.uniform(-2000, 2000), random.uniform(-2000, 2000));
      return Vec3(p.x(), p.y(), -hills.elevation_msl(p) - random.uniform(0, 80));
    };
    const Vec3 a = place(), b = place();
    const double loss = field.loss_db(a, b);
    ASSERT_GE(loss, 0);
    ASSERT_EQ(loss, field.loss_db(b, a));
    ASSERT_EQ(field.received(1, a, b), field.received(1, b, a));
    lossy += loss > 0;
  }
  EXPECT_GT(lossy, 300);  // the test sees both cases
  EXPECT_LT(lossy, 1900);
}

TEST(TerrainDiffraction, LooksAtNothingWhereBothAreHighAbove) {
  const KnownWall wall(500, 40);
  const Wall unknown(500, 40);
  const TerrainDiffraction field = over(wall), slow = over(unknown);
  EXPECT_EQ(field.loss_db({0, 0, -100}, {1000, 0, -80}), 0);
  EXPECT_EQ(wall.looks, 0);
  // What is known of the greatest height saves looks and changes nothing.
  for (double height = -10; height <= 120; height += 1)
    for (const double other : {-5.0, 30.0, 45.0, 60.0, 200.0})
      EXPECT_EQ(field.loss_db({0, 0, -height}, {1000, 0, -other}),
                slow.loss_db({0, 0, -height}, {1000, 0, -other}))
          << height << " " << other;
  EXPECT_LT(wall.looks, unknown.looks);
}

TEST(TerrainDiffraction, LooksAtABoundedNumberOfPlaces) {
  const Wall wall(500, 40);
  over(wall).loss_db({0, 0, 0}, {1e6, 0, 0});
  EXPECT_EQ(wall.looks, TerrainDiffraction::kMaxSamples);
  wall.looks = 0;
  EXPECT_EQ(over(wall).loss_db({0, 0, 0}, {15, 0, 0}), 0);
  EXPECT_EQ(wall.looks, 0);
}

TEST(TerrainDiffraction, TakesFromThePowerOfTheOpenField) {
  const Wall wall(500, 0);
  const FreeSpace open(kFrequency);
  const TerrainDiffraction field = over(wall);
  const Vec3 a(0, 0, 0), b(1000, 0, 0);
  const double loss = -10 * std::log10(field.received(2, a, b) / open.received(2, a, b));
  EXPECT_NEAR(loss, field.loss_db(a, b), 1e-9);  // roundings
}

}  // namespace
}  // namespace skein::communication::terrain_diffraction_test
