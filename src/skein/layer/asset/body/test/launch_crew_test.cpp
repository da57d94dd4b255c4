// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/asset/body/launch_crew.h"

#include <gtest/gtest.h>

namespace skein::asset::launch_crew_test {
namespace {

constexpr double kStep = 0.01;
const Vec3 kCalm = Vec3::Zero();

VehicleState in_hand() {
  VehicleState s;
  s.p_N = {0, 0, -1.8};
  s.q_NB = geo::from_euler({0, 0.26, 0.7});
  s.held = s.on_ground = true;
  return s;
}

TEST(LaunchCrew, HoldsUntilTheMotorHasPower) {
  for (const bool by_hand : {false, true}) {
    const auto launch = by_hand ? std::optional<HandLaunch>(HandLaunch{}) : std::nullopt;
    VehicleState s = in_hand();
    const Vec3 place = s.p_N;
    for (int i = 0; i < 500; ++i) EXPECT_TRUE(hold(launch, s, 0.4, kCalm, kStep));
    EXPECT_EQ(s.p_N, place);
    EXPECT_TRUE(s.held && s.v_N.isZero());
  }
}

TEST(LaunchCrew, LetsGoOfWhatRolls) {
  VehicleState s = in_hand();
  EXPECT_FALSE(hold(std::nullopt, s, 0.6, kCalm, kStep));
  EXPECT_FALSE(s.held);
  EXPECT_TRUE(s.v_N.isZero());
}

TEST(LaunchCrew, ThrowsAlongTheNoseWithTheSpeedAndOverTheReach) {
  const HandLaunch launch;
  VehicleState s = in_hand();
  const Vec3 place = s.p_N, nose = s.q_NB * Vec3::UnitX();
  // Nothing stops it once it is pushed.
  EXPECT_TRUE(hold(launch, s, 0.95, kCalm, kStep));
  int steps = 1;
  for (; hold(launch, s, 0, kCalm, kStep); ++steps) ASSERT_LT(steps, 100);
  EXPECT_FALSE(s.held);
  const double step = launch.speed * launch.speed / (2 * launch.reach) * kStep;
  EXPECT_NEAR(s.v_N.norm(), launch.speed, step);  // whole steps
  EXPECT_NEAR(s.v_N.normalized().dot(nose), 1, 1e-12);
  EXPECT_NEAR((s.p_N - place).dot(nose), launch.reach, launch.speed * kStep);
}

TEST(LaunchCrew, WaitsForTheWindToBlowFromAhead) {
  const auto thrown = [](double speed, double from) {
    VehicleState s = in_hand();
    const Vec2 wind = -speed * geo::unit(0.7 + from);
    hold(HandLaunch{}, s, 1, {wind.x(), wind.y(), 0}, kStep);
    return !s.v_N.isZero();
  };
  EXPECT_TRUE(thrown(6, 0));
  EXPECT_TRUE(thrown(6, 0.5));
  EXPECT_FALSE(thrown(6, 1.2)) << "from aside";
  EXPECT_FALSE(thrown(4, geo::kPi)) << "from behind";
  EXPECT_TRUE(thrown(1, geo::kPi)) << "hardly any";
}

TEST(LaunchCrew, SaysWhichNumbersNobodyThrowsWith) {
  EXPECT_TRUE(errors(HandLaunch{}).empty());
  EXPECT_EQ(errors({.speed = 0, .pitch = 1.3, .height = 0, .reach = -1}).size(), 4u);
}

}  // namespace
}  // namespace skein::asset::launch_crew_test
