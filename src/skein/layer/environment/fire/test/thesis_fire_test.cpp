// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/environment/fire/thesis_fire.h"

#include <gtest/gtest.h>

#include <limits>

#include "skein/geo/boundary_index.h"
#include "skein/geo/clip.h"

namespace skein::environment::thesis_fire_test {
namespace {

using geo::kPi;

class Plane : public Terrain {
 public:
  explicit Plane(const Vec2& gradient) : gradient_(gradient) {}
  double elevation_msl(const Vec2& p) const override { return gradient_.dot(p); }
  Vec2 gradient(const Vec2&) const override { return gradient_; }

 private:
  Vec2 gradient_;
};

const Plane kFlat(Vec2::Zero());

// The fire of the thesis's figures 4.7 and 4.8: 2 m/s, 35 s, no randomness.
ThesisFireOptions plain() {
  ThesisFireOptions o;
  o.points = 60;
  o.start_radius = 10;
  o.displacement = 0;
  o.rate = 2;
  o.rate_error = 0;
  return o;
}

TEST(ThesisFire, GrowsCirclesWithoutWind) {
  ThesisFire fire(plain(), 1, kFlat);
  for (int t : {7, 14, 21, 28, 35}) {
    fire.advance(Time::from_seconds(t));
    ASSERT_EQ(fire.region().size(), 1u);
    ASSERT_EQ(fire.region()[0].size(), 60u);
    for (const Vec2& p : fire.region()[0]) EXPECT_NEAR(p.norm(), 10 + 2 * t, 1e-9);
  }
}

TEST(ThesisFire, MovesAtAllTimesWhateverTimesWereAskedBefore) {
  ThesisFireOptions o;  // uneven in rate and shape, points are added
  o.wind = Vec2(1, -1);
  o.slope_weight = 0.5;
  const Plane hill(Vec2(0.1, 0.2));
  ThesisFire often(o, 1, hill), once(o, 1, hill);
  Vec2 before = often.region()[0][0];
  for (int k = 1; k <= 1234; ++k) {
    often.advance(Time::from_seconds(0.1 * k));
    if (k > 20) continue;
    // Every tenth of a second, at about the same speed.
    const Vec2 now = often.region()[0][0];
    EXPECT_NEAR((now - before).norm(), 0.3, 0.2) << k;
    before = now;
  }
  once.advance(Time::from_seconds(123.4));
  ASSERT_EQ(once.region()[0].size(), often.region()[0].size());
  for (std::size_t i = 0; i < once.region()[0].size(); ++i)
    EXPECT_EQ(once.region()[0][i], often.region()[0][i]) << i;
  EXPECT_TRUE(once.inside(once.region()[0][0] * 0.999));
}

TEST(ThesisFire, ASouthWestWindOfATenthIsVisible) {
  ThesisFireOptions o = plain();
  o.wind = 0.1 * geo::unit(kPi / 4);
  ThesisFire fire(o, 1, kFlat);
  fire.advance(Time::from_seconds(35));
  double north_east = 0, south_west = 0;
  for (const Vec2& p : fire.region()[0]) {
    north_east = std::max(north_east, p.dot(geo::unit(kPi / 4)));
    south_west = std::max(south_west, -p.dot(geo::unit(kPi / 4)));
  }
  // Along the wind's line bearings stay: 2.1 m/s ahead, 1.9 m/s against it; points stand
  // 3 deg off that line, 0.14 % of 83 m.
  EXPECT_NEAR(north_east, 10 + 2.1 * 35, 0.15);
  EXPECT_NEAR(south_west, 10 + 1.9 * 35, 0.15);
}

TEST(ThesisFire, PointsFollowTheAnalyticPathInWind) {
  // With p = r e(psi), r' = V + W cos(psi - w) and r psi' = -W sin(psi - w), the path
  // obeys r sin(psi - w) = C tan(|psi - w| / 2)^(-V / W): d ln(r sin)/d psi = -(V/W) /
  // sin.
  ThesisFireOptions o = plain();
  o.rate = 3;
  o.wind = {1, 0};
  o.start_radius = 500;
  o.points = 36;
  o.respace = false;
  ThesisFire fire(o, 1, kFlat);
  const geo::Ring start = fire.region()[0];
  fire.advance(Time::from_seconds(3600));
  const geo::Ring end = fire.region()[0];
  const auto invariant = [](const Vec2& p) {
    const double psi = std::abs(geo::bearing(p));
    return std::log(p.norm() * std::sin(psi)) + 3 * std::log(std::tan(psi / 2));
  };
  for (std::size_t i = 1; i < 36; ++i) {
    if (i == 18) continue;  // due against the wind
    EXPECT_GT((end[i] - start[i]).norm(), 7000);
    EXPECT_NEAR(invariant(end[i]), invariant(start[i]), 1e-7) << i;  // RK4, steps of 1 s
  }
  EXPECT_NEAR(end[0].x(), 500 + 4 * 3600, 1e-6);
  EXPECT_NEAR(end[18].x(), -500 - 2 * 3600, 1e-6);
}

TEST(ThesisFire, SlopeIsAFactorOfTheRate) {
  ThesisFireOptions o = plain();
  o.slope_weight = 1;
  const Plane north_up({0.3, 0});
  ThesisFire fire(o, 1, north_up);
  fire.advance(Time::from_seconds(35));
  const geo::Ring& ring = fire.region()[0];
  EXPECT_NEAR(ring[0].x(), 10 + 2 * 1.3 * 35, 1e-9);
  EXPECT_NEAR(ring[30].x(), -(10 + 2 * 0.7 * 35), 1e-9);
  EXPECT_NEAR(ring[15].norm(), 10 + 2 * 35, 1e-9);  // across the slope
}

TEST(ThesisFire, StartAndRateFollowTheirProfiles) {
  ThesisFireOptions o;
  ThesisFire fire(o, 42, kFlat);
  const geo::Ring start = fire.region()[0];
  fire.advance(Time::from_seconds(100));
  double min = 1e9, max = 0;
  for (std::size_t i = 0; i < start.size(); ++i) {
    const double bearing = geo::bearing(start[i]);
    EXPECT_NEAR(start[i].norm(), fire.start_radius(bearing), 1e-9);
    EXPECT_NEAR(fire.region()[0][i].norm() - start[i].norm(), 100 * fire.rate(bearing),
                1e-6);
    EXPECT_LE(std::abs(fire.rate(bearing) - 3), 0.1001);
    min = std::min(min, start[i].norm());
    max = std::max(max, start[i].norm());
  }
  EXPECT_GE(min, 319);
  EXPECT_LE(max, 681);
  EXPECT_GT(max - min, 180);
}

TEST(ThesisFire, HundredSecondsOrOneAtATimeIsTheSame) {
  ThesisFireOptions o;
  o.wind = {-0.7, 0.7};
  ThesisFire once(o, 3, kFlat), often(o, 3, kFlat);
  once.advance(Time::from_seconds(600));
  for (int k = 1; k <= 6000; ++k) often.advance(Time::from_seconds(0.1 * k));
  EXPECT_EQ(once.region(), often.region());
}

TEST(ThesisFire, StaysSmoothForAnHourOfStrongWind) {
  ThesisFireOptions o;
  o.wind = geo::unit(kPi / 4);
  o.step = 5;
  ThesisFire fire(o, 11, kFlat);
  o.points = 1440;
  o.respace = false;
  ThesisFire fine(o, 11, kFlat);
  for (int t = 600; t <= 3600; t += 600) {
    fire.advance(Time::from_seconds(t));
    fine.advance(Time::from_seconds(t));
    const geo::Ring& ring = fire.region()[0];
    ASSERT_EQ(fire.region().size(), 1u);
    // Nothing crosses: the clean region is the same.
    EXPECT_NEAR(geo::area(geo::clean(fire.region(), geo::FillRule::kPositive)) /
                    geo::area(fire.region()),
                1, 1e-9);
    const double mean = geo::length(fire.region()) / 360;
    for (std::size_t i = 0; i < ring.size(); ++i)
      EXPECT_LT((ring[(i + 1) % ring.size()] - ring[i]).norm(), 1.6 * mean);
    // Chords of 1.5 deg lie (0.013)^2 r off an arc: 2 m at 11 km.
    geo::BoundaryIndex index(fine.region());
    for (const Vec2& p : ring) EXPECT_LT(index.nearest(p).distance, 0.1);
    EXPECT_NEAR(geo::area(fire.region()) / geo::area(fine.region()), 1, 3e-4);
  }
}

TEST(ThesisFire, RatesPerSectorMakeJumpsButNoCrossings) {
  ThesisFireOptions o;
  o.rate_sectors = 60;
  ThesisFire fire(o, 5, kFlat);
  fire.advance(Time::from_seconds(1800));
  const geo::Region& region = fire.region();
  EXPECT_EQ(region.size(), 1u);
  EXPECT_NEAR(geo::area(geo::clean(region, geo::FillRule::kPositive)) / geo::area(region),
              1, 1e-9);
  for (int k = 0; k < 60; ++k) {  // in the middle of each sector
    const double bearing = geo::radians(6 * k + 3);
    const double radius = fire.start_radius(bearing) + 1800 * fire.rate(bearing);
    EXPECT_TRUE(fire.inside((radius - 1) * geo::unit(bearing)));
    EXPECT_FALSE(fire.inside((radius + 1) * geo::unit(bearing)));
  }
}

TEST(ThesisFire, InsideAgreesWithItsRegion) {
  ThesisFireOptions o;
  o.wind = {0.5, 0.5};
  ThesisFire fire(o, 9, kFlat);
  RandomStream random(1, 0, Purpose::kTest);
  for (int t = 0; t <= 1200; t += 300) {
    fire.advance(Time::from_seconds(t));
    for (int i = 0; i < 300; ++i) {
      const double north = random.uniform(-6000, 6000),
                   east = random.uniform(-6000, 6000);
      const Vec2 p = Vec2(north, east);
      EXPECT_EQ(fire.inside(p), geo::contains(fire.region(), p));
    }
  }
}

TEST(ThesisFire, StaysDefinedWhereTheWindDrivesItOverItsOrigin) {
  ThesisFireOptions o = plain();
  o.slope_weight = 1;
  o.wind = {1.5, 0};
  const Plane south_down({0.9, 0});  // 0.2 m/s to the south, against the wind
  ThesisFire fire(o, 1, south_down);
  for (int t = 10; t <= 600; t += 10) {
    fire.advance(Time::from_seconds(t));
    ASSERT_FALSE(fire.region().empty());
    std::size_t points = 0;
    for (const geo::Ring& ring : fire.region()) {
      points += ring.size();
      for (const Vec2& p : ring) ASSERT_TRUE(p.allFinite());
    }
    EXPECT_LE(points, 10u * 60);
  }
  EXPECT_TRUE(fire.inside({10 + (2 * 1.9 + 1.5) * 600 - 20, 0}));  // behind its head
}

TEST(ThesisFireOptions, RefusesImpossibleValues) {
  EXPECT_TRUE(check(ThesisFireOptions{}).ok());
  const auto refuses = [](auto change) {
    ThesisFireOptions o;
    change(o);
    return !check(o).ok();
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(refuses([](auto& o) { o.points = 2; }));
  EXPECT_TRUE(refuses([](auto& o) { o.wind = {3, 0}; }));
  EXPECT_TRUE(refuses([](auto& o) { o.displacement = 500; }));
  EXPECT_TRUE(refuses([](auto& o) { o.rate_error = 4; }));
  EXPECT_TRUE(refuses([&](auto& o) { o.rate = nan; }));
  EXPECT_TRUE(refuses([&](auto& o) { o.wind.x() = nan; }));
  EXPECT_TRUE(refuses([&](auto& o) { o.origin.x() = nan; }));
  EXPECT_TRUE(refuses([&](auto& o) { o.slope_weight = nan; }));
  EXPECT_TRUE(refuses([](auto& o) { o.step = 0; }));
}

}  // namespace
}  // namespace skein::environment::thesis_fire_test
