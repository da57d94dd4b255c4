// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/environment/fire/front_fire.h"

#include <gtest/gtest.h>

#include <limits>
#include <thread>

#include "skein/base/random.h"
#include "skein/geo/clip.h"

namespace skein::environment::front_fire_test {
namespace {

using geo::kPi;

class Hills : public Terrain {
 public:
  double elevation_msl(const Vec2& p) const override {
    return 60 * std::sin(p.x() / 400) * std::cos(p.y() / 300);
  }
  Vec2 gradient(const Vec2& p) const override {
    return {0.15 * std::cos(p.x() / 400) * std::cos(p.y() / 300),
            -0.2 * std::sin(p.x() / 400) * std::sin(p.y() / 300)};
  }
};

class Flat : public Terrain {
 public:
  double elevation_msl(const Vec2&) const override { return 0; }
  Vec2 gradient(const Vec2&) const override { return Vec2::Zero(); }
};

class Steady : public WindField {
 public:
  explicit Steady(const Vec2& wind) : wind_(wind.x(), wind.y(), 0) {}
  Vec3 wind(const Vec3&, Time time) const override {
    EXPECT_GE(time, Time());  // a fire older than the run does not ask for the past
    return wind_;
  }

 private:
  Vec3 wind_;
};

const Flat kFlat;
const Hills kHills;
const Steady kCalm(Vec2::Zero());
const Steady kBreeze(Vec2(3, 2));

TEST(FrontFire, BurnsACircleInCalmOnLevelGround) {
  FrontFireOptions o;
  o.spread.rate = 0.3;
  FrontFire fire(o, kFlat, kCalm, nullptr);
  fire.advance(Time::from_seconds(1800));
  // The boundary may lag by a quarter of the spacing, 2.5 m in 560 m.
  EXPECT_NEAR(geo::area(fire.region()) / (kPi * 560 * 560), 1, 0.01);
}

TEST(FrontFire, AnOlderFireIsLarger) {
  FrontFireOptions o;
  o.spread.rate = 0.3;
  o.age = 1000;
  FrontFire fire(o, kFlat, kBreeze, nullptr);
  FrontFireOptions young = o;
  young.age = 0;
  FrontFire later(young, kFlat, kBreeze, nullptr);
  EXPECT_GT(geo::area(fire.region()), 10 * geo::area(later.region()));
  later.advance(Time::from_seconds(1000));
  EXPECT_NEAR(geo::area(fire.region()) / geo::area(later.region()), 1, 0.02);
}

TEST(FrontFire, FuelSetsTheRateAndStopsIt) {
  class Halves : public FuelField {
    double factor(const Vec2& p) const override {
      return p.x() > 150 ? 0 : p.x() < 0 ? 2 : 1;
    }
  };
  FrontFireOptions o;
  o.spread.rate = 0.2;
  FrontFire fire(o, kFlat, kCalm, std::make_shared<Halves>());
  fire.advance(Time::from_seconds(2000));
  double north = 0, south = 0, east = 0;
  for (const Vec2& p : fire.region()[0]) {
    north = std::max(north, p.x());
    south = std::max(south, -p.x());
    east = std::max(east, p.y());
  }
  EXPECT_NEAR(north, 150, 3);  // a step of a quarter spacing beyond the edge
  EXPECT_NEAR(south, 20 + 0.4 * 2000, 0.01 * 820);
  EXPECT_GT(east, 20 + 0.2 * 2000);
}

TEST(FrontFire, AsksForTheWindAboveTheGround) {
  class Shear : public WindField {
   public:
    Vec3 wind(const Vec3& p, Time) const override {
      EXPECT_NEAR(p.z(), -10 - kHills.elevation_msl({p.x(), p.y()}), 1e-9);
      ++asked;
      return Vec3::Zero();
    }
    mutable int asked = 0;
  };
  FrontFireOptions o;
  const Shear shear;
  FrontFire fire(o, kHills, shear, nullptr);
  fire.advance(Time::from_seconds(60));
  EXPECT_GT(shear.asked, 0);
}

TEST(FrontFire, LaterIgnitionsStartTheirOwnFronts) {
  FrontFireOptions o;
  o.spread.rate = 0.3;
  o.ignitions = {{{800, 0}, 15, 600}, {{0, 0}, 20, 0}, {{0, 900}, 15, 300.5}};
  FrontFire fire(o, kFlat, kCalm, nullptr);
  EXPECT_EQ(fire.region().size(), 1u);
  fire.advance(Time::from_seconds(300));
  EXPECT_EQ(fire.region().size(), 1u);
  fire.advance(Time::from_seconds(301));
  EXPECT_EQ(fire.region().size(), 2u);
  EXPECT_TRUE(fire.inside({0, 910}));
  fire.advance(Time::from_seconds(700));
  EXPECT_EQ(fire.region().size(), 3u);
  fire.advance(Time::from_seconds(2400));
  EXPECT_EQ(geo::signed_area(fire.region()[0]) > 0, true);
  EXPECT_TRUE(fire.inside({450, 0}));
}

TEST(FrontFire, DoesNotDependOnHowOftenItIsAdvanced) {
  FrontFireOptions o;
  o.spread.rate = 0.2;
  o.ignitions.push_back({{300, 300}, 20, 411.3});
  const auto fuel = std::make_shared<PatchyFuel>(PatchyFuelOptions{80, 0.4, 0.05}, 3);
  FrontFire once(o, kHills, kBreeze, fuel), often(o, kHills, kBreeze, fuel);
  once.advance(Time::from_seconds(1200));
  for (int k = 1; k <= 12000; ++k) often.advance(Time::from_seconds(0.1 * k));
  EXPECT_EQ(once.region(), often.region());
}

TEST(FrontFire, ManyThreadsMayAskAtOnce) {
  FrontFireOptions o;
  o.spread.rate = 0.2;
  o.age = 600;
  FrontFire fire(o, kHills, kBreeze,
                 std::make_shared<PatchyFuel>(PatchyFuelOptions{}, 4));
  for (int t = 100; t <= 500; t += 100) {
    fire.advance(Time::from_seconds(t));
    std::vector<int> wrong(3, 0);
    std::vector<std::thread> threads;
    for (std::uint32_t k = 0; k < 3; ++k)
      threads.emplace_back([&, k] {
        RandomStream random(1, k, Purpose::kTest);
        for (int i = 0; i < 500; ++i) {
          const double north = random.uniform(-300, 600),
                       east = random.uniform(-300, 600);
          const Vec2 p(north, east);
          wrong[k] += fire.inside(p) != geo::contains(fire.region(), p);
        }
      });
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(wrong, std::vector<int>(3, 0));
  }
}

TEST(FrontFire, StartsFromAGivenRegionWithAHole) {
  const auto ring = [](double radius, bool hole) {
    geo::Ring r;
    for (int i = 0; i < 100; ++i)
      r.push_back(radius * geo::unit((hole ? -1 : 1) * 2 * kPi * i / 100));
    return r;
  };
  FrontFireOptions o;
  o.ignitions.clear();
  o.start = {ring(300, false), ring(150, true)};
  o.spread.rate = 0.1;
  FrontFire fire(o, kFlat, kCalm, nullptr);
  EXPECT_FALSE(fire.inside({0, 0}));
  fire.advance(Time::from_seconds(1000));  // hole of 50 m
  EXPECT_FALSE(fire.inside({0, 0}));
  EXPECT_TRUE(fire.inside({60, 0}));
  fire.advance(Time::from_seconds(1600));
  EXPECT_TRUE(fire.inside({0, 0}));
}

TEST(FrontFireOptions, RefusesImpossibleValues) {
  EXPECT_TRUE(check(FrontFireOptions{}).ok());
  const auto refuses = [](auto change) {
    FrontFireOptions o;
    change(o);
    return !check(o).ok();
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(refuses([](auto& o) { o.ignitions.clear(); }));
  EXPECT_TRUE(refuses([](auto& o) { o.ignitions[0].radius = 0; }));
  EXPECT_TRUE(refuses([&](auto& o) { o.ignitions[0].point.y() = nan; }));
  EXPECT_TRUE(refuses([&](auto& o) { o.ignitions[0].delay = nan; }));
  EXPECT_TRUE(refuses([&](auto& o) { o.age = nan; }));
  EXPECT_TRUE(refuses([&](auto& o) { o.wind_height = nan; }));
  EXPECT_TRUE(refuses([](auto& o) { o.spread.rate = 1e3; }));
  EXPECT_TRUE(refuses([](auto& o) { o.front.spacing = 0; }));
  EXPECT_TRUE(refuses([&](auto& o) { o.start = {{{0, 0}, {1, 0}, {nan, 1}}}; }));
}

}  // namespace
}  // namespace skein::environment::front_fire_test
