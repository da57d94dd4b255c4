// SPDX-License-Identifier: Apache-2.0
#include "skein/simulation/flight_ahead.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace skein::simulation::flight_ahead_test {
namespace {

NavEstimate at(double north, double east, double speed) {
  NavEstimate nav;
  nav.p_N = {north, east, -100};
  nav.v_N = {speed, 0, 0};
  return nav;
}

AutopilotCommand to(std::vector<Vec2> points) {
  FlyWaypoints fly;
  for (const Vec2& point : points) fly.points.push_back({point, 120});
  AutopilotCommand command;
  command.guidance = fly;
  return command;
}

AutopilotCommand on_course(double course) {
  AutopilotCommand command;
  command.guidance = HoldCourse{course};
  return command;
}

Time seconds(double t) {
  return Time::from_seconds(t);
}

TEST(FlightAhead, LeadsFromHereAlongWaypointsAtTheSpeedFlown) {
  FlightAhead ahead;
  const AutopilotCommand command = to({{200, 0}, {200, 100}});
  const auto path = ahead.step(&command, at(0, 0, 20), seconds(5));
  ASSERT_TRUE(path);
  ASSERT_EQ(path->points.size(), 3U);
  EXPECT_FLOAT_EQ(path->points[0].altitude_msl, 100);
  EXPECT_FLOAT_EQ(path->points[1].north, 200);
  EXPECT_FLOAT_EQ(path->points[1].altitude_msl, 120);
  EXPECT_FLOAT_EQ(path->points[1].ahead, 10);
  EXPECT_FLOAT_EQ(path->points[2].ahead, 15);
  EXPECT_TRUE(path->ends);
}

TEST(FlightAhead, OfAPlanOnlyWhatIsAheadAndWhereItBends) {
  // 100 s straight on, then a quarter turn of 100 m.
  Plan plan;
  for (int k = 0; k <= 100; ++k)
    plan.push_back({seconds(k), {20.0 * k, 0, -100}, {20, 0, 0}});
  for (int k = 1; k <= 16; ++k) {
    const double angle = k * geo::kPi / 32;
    plan.push_back({seconds(100 + 5 * angle),
                    {2000 + 100 * std::sin(angle), 100 - 100 * std::cos(angle), -100},
                    {20 * std::cos(angle), 20 * std::sin(angle), 0}});
  }
  AutopilotCommand command;
  command.guidance = FollowPlan{plan};
  FlightAhead ahead;
  const auto path = ahead.step(&command, at(800, 0, 20), seconds(40));
  ASSERT_TRUE(path);
  EXPECT_LT(path->points.size(), 10U);
  EXPECT_GT(path->points.size(), 4U);
  EXPECT_FLOAT_EQ(path->points.front().north, 800);
  EXPECT_NEAR(path->points.back().ahead, 60 + 5 * geo::kPi / 2, 1e-3);
  // No sample of the plan is far from the pieces.
  for (const PlanPoint& sample : plan) {
    if (sample.time < seconds(41)) continue;
    double least = 1e9;
    for (std::size_t k = 1; k < path->points.size(); ++k) {
      const PathPoint &p = path->points[k - 1], &q = path->points[k];
      const Vec2 from(p.north, p.east), leg = Vec2(q.north, q.east) - from;
      const Vec2 off = geo::horizontal(sample.p_N) - from;
      const double share = std::clamp(off.dot(leg) / leg.squaredNorm(), 0.0, 1.0);
      least = std::min(least, (off - share * leg).norm());
    }
    EXPECT_LT(least, 2.1);
  }
}

TEST(FlightAhead, IsSaidOnceAndAgainWhenItIsAnother) {
  FlightAhead ahead;
  const AutopilotCommand one = to({{200, 0}}), other = to({{0, 200}});
  EXPECT_TRUE(ahead.step(&one, at(0, 0, 20), seconds(0)));
  EXPECT_FALSE(ahead.step(&one, at(20, 0, 20), seconds(1)));
  EXPECT_FALSE(ahead.step(nullptr, at(100, 0, 20), seconds(5)));
  EXPECT_TRUE(ahead.step(&other, at(120, 0, 20), seconds(6)));
  // Too soon after the last it is said later, though it is commanded only once.
  EXPECT_FALSE(ahead.step(&one, at(130, 0, 20), seconds(6.5)));
  EXPECT_FALSE(ahead.step(nullptr, at(140, 0, 20), seconds(7)));
  const auto late = ahead.step(nullptr, at(160, 0, 20), seconds(8));
  ASSERT_TRUE(late);
  EXPECT_FLOAT_EQ(late->points.back().north, 200);
  EXPECT_FALSE(ahead.step(nullptr, at(160, 0, 20), seconds(20)));
}

TEST(FlightAhead, ACourseIsSaidAgainNowAndThenOrWhenItTurns) {
  FlightAhead ahead;
  int said = 0;
  for (int k = 0; k < 100; ++k) {
    const AutopilotCommand command = on_course(0.001 * k);
    said += ahead.step(&command, at(0, 0, 20), seconds(0.2 * k)).has_value();
  }
  EXPECT_EQ(said, 2);  // at 0 and 10 s
  const AutopilotCommand turned = on_course(1);
  const auto path = ahead.step(&turned, at(0, 0, 20), seconds(20));
  ASSERT_TRUE(path);
  EXPECT_FALSE(path->ends);
  EXPECT_NEAR(path->points.back().east, 600 * std::sin(1), 0.01);
}

TEST(FlightAhead, ACircleThatIsAWiderOrNarrowerOneAsTheWindVariesIsTheSame) {
  FlightAhead ahead;
  int said = 0;
  AutopilotCommand command;
  for (int k = 0; k < 200; ++k) {
    command.guidance =
        Circle{{100 + 2 * std::sin(k), 50}, 80 + 5 * std::cos(3.0 * k), true};
    said += ahead.step(&command, at(0, 0, 20), seconds(0.5 * k)).has_value();
  }
  EXPECT_EQ(said, 1);
  command.guidance = Circle{{130, 50}, 80, true};
  EXPECT_TRUE(ahead.step(&command, at(0, 0, 20), seconds(200)));
  command.guidance = Circle{{130, 50}, 80, false};
  EXPECT_TRUE(ahead.step(&command, at(0, 0, 20), seconds(300)));
}

TEST(FlightAhead, IsBoundedHoweverLongAFlightIs) {
  FlightAhead ahead;
  std::vector<Vec2> points;
  for (int k = 0; k < 5000; ++k) points.emplace_back(k % 2 * 500, 20 * k);
  const AutopilotCommand command = to(points);
  const auto path = ahead.step(&command, at(0, 0, 20), seconds(0));
  ASSERT_TRUE(path);
  EXPECT_EQ(path->points.size(), 400U);
  EXPECT_FALSE(path->ends);
}

}  // namespace
}  // namespace skein::simulation::flight_ahead_test
