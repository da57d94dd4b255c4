// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <functional>

#include "skein/layer/environment/object/evading_motion.h"
#include "skein/layer/environment/object/even_motion.h"
#include "skein/layer/environment/object/route_motion.h"

namespace skein::environment::motion_test {
namespace {

// Where it is at each whole second, moved in steps of `step_s`.
std::vector<Vec2> places(MovingObject& object, int seconds, double step_s,
                         const std::vector<Vec3>& aircraft = {}) {
  std::vector<Vec2> all;
  const int steps = static_cast<int>(std::lround(1 / step_s));
  for (int i = 0; i <= seconds * steps; ++i) {
    object.advance({Time::from_seconds(i * step_s), aircraft});
    if (i % steps == 0) all.push_back(object.position());
  }
  return all;
}

TEST(EvenMotion, GoesStraightOn) {
  EvenMotion object({10, 20}, {1, -2});
  EXPECT_LT((places(object, 30, 0.1).back() - Vec2(40, -40)).norm(), 1e-9);
}

TEST(RouteMotion, StaysTurnsBackOrGoesRound) {
  RouteMotionOptions options;
  options.points = {{100, 0}, {100, 50}};
  options.speed = 2;
  const auto after = [&](RouteEnd end, int seconds) {
    options.end = end;
    RouteMotion object({0, 0}, options);
    return Vec2(places(object, seconds, 0.1).back());
  };
  EXPECT_LT((after(RouteEnd::kStay, 30) - Vec2(60, 0)).norm(), 1e-9);
  EXPECT_LT((after(RouteEnd::kStay, 60) - Vec2(100, 20)).norm(), 1e-9);
  EXPECT_LT((after(RouteEnd::kStay, 500) - Vec2(100, 50)).norm(), 1e-9);
  // 150 m there; 10 s later it is 20 m back.
  EXPECT_LT((after(RouteEnd::kBack, 85) - Vec2(100, 30)).norm(), 1e-9);
  EXPECT_LT((after(RouteEnd::kBack, 160) - Vec2(20, 0)).norm(), 1e-9);
  // Home is 111.8 m away.
  const Vec2 home = Vec2(-100, -50).normalized();
  EXPECT_LT((after(RouteEnd::kRound, 85) - (Vec2(100, 50) + 20 * home)).norm(), 1e-9);
}

TEST(RouteMotion, PassesOverPointsThatAreTheSame) {
  RouteMotionOptions options;
  options.points = {{0, 0}, {10, 0}, {10, 0}, {10, 10}};
  options.speed = 1;
  RouteMotion object({0, 0}, options);
  const std::vector<Vec2> all = places(object, 25, 0.1);
  EXPECT_LT((all[15] - Vec2(10, 5)).norm(), 1e-9);
  EXPECT_LT((all[25] - Vec2(10, 10)).norm(), 1e-9);
}

TEST(RandomWalk, HasItsSpeedItsLegsAndItsRadius) {
  RandomWalkOptions options;
  options.speed = 1.5;
  options.mean_leg = 40;
  options.radius = 200;
  double furthest = 0;
  int turns = 0;
  Vec2 sum = Vec2::Zero();
  for (std::uint32_t k = 0; k < 20; ++k) {
    RandomWalk object({1000, -500}, options, 1, k);
    Vec2 heading = Vec2::Zero();
    for (int i = 0; i <= 3600; ++i) {
      object.advance({Time::from_seconds(i), {}});
      furthest = std::max(furthest, (object.position() - Vec2(1000, -500)).norm());
      EXPECT_NEAR(object.velocity().norm(), 1.5, 1e-9);
      if (!(object.velocity() - heading).isZero(1e-9)) ++turns;
      heading = object.velocity();
      sum += heading;
    }
  }
  // 20 hours of legs of 40 s: 1,800 turns, standard deviation 42; a few fall together
  // within a second.
  EXPECT_NEAR(turns, 1780, 170);
  // Not a whole leg beyond: one of 300 s would be of e^-7.5.
  EXPECT_LT(furthest, 200 + 1.5 * 300);
  EXPECT_GT(furthest, 200);
  EXPECT_LT((sum / (20 * 3600)).norm(), 0.15);  // no direction is preferred
}

TEST(RandomWalk, DoesNotDependOnTheStepAndDiffersByObjectAndSeed) {
  RandomWalk coarse({0, 0}, {}, 1, 4), fine({0, 0}, {}, 1, 4);
  const auto a = places(coarse, 600, 1), b = places(fine, 600, 0.1);
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_LT((a[i] - b[i]).norm(), 1e-6);
  RandomWalk other({0, 0}, {}, 1, 5), seed({0, 0}, {}, 2, 4);
  EXPECT_GT((places(other, 600, 1).back() - a.back()).norm(), 1);
  EXPECT_GT((places(seed, 600, 1).back() - a.back()).norm(), 1);
}

TEST(EvadingMotion, WalksUntilAnAircraftComesNearAndRunsAway) {
  EvadingMotionOptions options;
  EvadingMotion undisturbed({0, 0}, options, 1, 0);
  RandomWalk walk({0, 0}, options.walk, 1, 0);
  const auto far = places(undisturbed, 300, 0.1, {{1000, 0, -100}});
  const auto walked = places(walk, 300, 0.1);
  for (std::size_t i = 0; i < far.size(); ++i)
    EXPECT_LT((far[i] - walked[i]).norm(), 1e-9);

  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    EvadingMotion hunted({0, 0}, options, seed, 0);
    const auto all = places(hunted, 120, 0.1, {{1000, 0, -100}, {0, 150, -100}});
    EXPECT_LT(all.back().y(), -100);  // the aircraft hovers in the east
    for (std::size_t i = 20; i < 40; ++i)
      EXPECT_NEAR((all[i + 1] - all[i]).norm(), options.flee_speed, 0.1 * 3);
  }
}

TEST(EvadingMotion, CalmsDownAndGoesOnFromWhereItIs) {
  EvadingMotionOptions options;
  EvadingMotion object({0, 0}, options, 1, 0);
  places(object, 30, 0.1, {{50, 0, -100}});
  const Vec2 then = object.position();
  for (int i = 301; i <= 900; ++i) object.advance({Time::from_seconds(0.1 * i), {}});
  EXPECT_NEAR(object.velocity().norm(), options.walk.speed, 1e-9);
  // Until it is calm it runs on: 20 s and the time to the next decision.
  const double ran = (object.position() - then).norm();
  EXPECT_LT(ran, 3 * 24 + 1.4 * 40);
  EXPECT_GT(ran, 10);
}

}  // namespace
}  // namespace skein::environment::motion_test
