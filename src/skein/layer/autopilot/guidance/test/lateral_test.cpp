// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/autopilot/guidance/lateral.h"

#include <gtest/gtest.h>

namespace skein::autopilot::lateral_test {
namespace {

struct Straight {
  Vec2 point, tangent;
  model::TrackPoint at(double ahead) const {
    return {point + ahead * tangent, tangent, 0};
  }
};

Sight sight_of(LateralLaw law, const LateralOptions& o) {
  return law == LateralLaw::kL1 ? l1_sight(o.l1) : l2_plus_sight(o.l2);
}

double on_straight(LateralLaw law, double off, const Vec2& velocity) {
  const LateralOptions o;
  const Straight line{{0, 0}, {1, 0}};
  if (law == LateralLaw::kCourse) return course_law(line.at(0), off, velocity, o.course);
  return sight_law(sight_of(law, o), line, line.at(0), off, {{0, off}, velocity, 0});
}

constexpr LateralLaw kLaws[] = {LateralLaw::kCourse, LateralLaw::kL1,
                                LateralLaw::kL2Plus};

TEST(Lateral, GivesTheCentripetalAccelerationOnACircle) {
  const LateralOptions o;
  for (const bool clockwise : {true, false})
    for (const double speed : {5.0, 15.0, 30.0}) {
      const CircleLine line =
          CircleLine::nearest_to({150, 100}, {100, 100}, 50, clockwise);
      const model::TrackPoint at = line.nearest();
      const double expected = (clockwise ? 1 : -1) * speed * speed / 50;
      const Vec2 v = speed * at.tangent;
      // Closed forms: rounding only.
      EXPECT_NEAR(course_law(at, 0, v, o.course), expected, 1e-9 * speed * speed);
      for (const LateralLaw law : {LateralLaw::kL1, LateralLaw::kL2Plus}) {
        // The chord must fit the circle: half of it bounds the gain.
        const Sight sight = sight_of(law, o);
        if (sight.distance(speed) > 75) continue;
        EXPECT_NEAR(sight_law(sight, line, at, 0, {at.position, v, 0}), expected,
                    1e-9 * speed * speed);
      }
    }
}

TEST(Lateral, L1HasThePeriodAndDampingAskedFor) {
  // e'' = a, with a = -2 zeta w e' - w^2 e for small motion: read off by differences.
  for (const double damping : {0.5, 0.7071, 1.0}) {
    LateralOptions o;
    o.l1.damping = damping;
    o.l1.period = 12;
    const double speed = 15, small = 1e-4, w = 2 * geo::kPi / 12;
    const Straight line{{0, 0}, {1, 0}};
    const Sight sight = l1_sight(o.l1);
    const auto a = [&](double off, double rate) {
      return sight_law(sight, line, line.at(0), off, {{0, off}, {speed, rate}, 0});
    };
    EXPECT_NEAR(a(small, 0) / small, -w * w, 1e-5 * w * w);
    EXPECT_NEAR(a(0, small) / small, -2 * damping * w, 1e-5 * w);
  }
}

TEST(Lateral, LeadsBackFromEitherSideAndAnyCourse) {
  for (const LateralLaw law : kLaws)
    for (const double off : {-500.0, -20.0, -1.0, 1.0, 20.0, 500.0}) {
      EXPECT_LT(on_straight(law, off, {15, 0}) * off, 0);
      // Flying away from the line or along it in the wrong direction, the turn is not
      // weaker.
      const double away = on_straight(law, off, {0, std::copysign(15, off)});
      EXPECT_LT(away * off, 0);
      EXPECT_NE(on_straight(law, off, {-15, 0}), 0);
    }
}

TEST(Lateral, JoinsItsTwoWaysOfAimingWithoutAStep) {
  for (const LateralLaw law : {LateralLaw::kL1, LateralLaw::kL2Plus}) {
    const Sight sight = sight_of(law, {});
    const double edge = sight.distance(15) * sight.sine;
    EXPECT_NEAR(on_straight(law, edge - 1e-9, {15, 1}),
                on_straight(law, edge + 1e-9, {15, 1}), 1e-6);
  }
}

TEST(Lateral, StandingStillGivesNothing) {
  for (const LateralLaw law : kLaws)
    EXPECT_EQ(on_straight(law, 10, {0, 0}), 0) << static_cast<int>(law);
}

TEST(Lateral, LooksAheadAlongATurn) {
  // A quarter turn of 50 m radius in steps: second order, so 1/100 of the step's error
  // for a tenth of the step.
  const double speed = 10, a = speed * speed / 50, lag = 0.3;
  const GroundMotion then = ahead_of({{0, 0}, {speed, 0}, a}, lag);
  const double turned = speed * lag / 50;
  EXPECT_NEAR((then.position - 50 * Vec2(std::sin(turned), 1 - std::cos(turned))).norm(),
              0, 1e-3);
  EXPECT_NEAR((then.velocity - speed * geo::unit(turned)).norm(), 0, 1e-3);
  EXPECT_NEAR(then.velocity.norm(), speed, 1e-12);
}

}  // namespace
}  // namespace skein::autopilot::lateral_test
