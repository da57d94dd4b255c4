// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/team/onboard/task_needs.h"

#include <gtest/gtest.h>

#include "skein/layer/reasoning/team/onboard/packed_task.h"

namespace skein::reasoning::task_needs_test {
namespace {

TEST(TaskNeeds, OfASurveyAreTheAreaOverTheDistanceOfItsLines) {
  Survey survey;
  survey.area = {{0, 0}, {1000, 0}, {1000, 600}, {0, 600}};
  survey.swath = 100;
  survey.overlap = 0.25;
  const TaskNeeds needs = needs_of(TaskKind(survey));
  EXPECT_DOUBLE_EQ(needs.length, 600e3 / 75);
  EXPECT_EQ(needs.centre, Vec2(500, 300));
  TeamResources resources;
  resources.speed = 20;
  FlightConditions conditions;
  EXPECT_DOUBLE_EQ(*time_within(needs, resources, conditions), 8000.0 / 20);
  conditions.set_wind({0, 10});
  EXPECT_DOUBLE_EQ(*time_within(needs, resources, conditions), 8000.0 * 20 / 300);
  conditions.set_wind({0, 20});
  EXPECT_FALSE(time_within(needs, resources, conditions));
}

TEST(TaskNeeds, SayWhichSensorsATaskTakes) {
  Orbit object;
  object.object = 3;
  EXPECT_EQ(needs_of(TaskKind(object)).sensors, kCameraSensor);
  EXPECT_EQ(needs_of(TaskKind(Orbit{})).sensors, 0u);
  EXPECT_EQ(needs_of(TaskKind(FollowEdge{})).sensors, kFireSensor);
  EXPECT_TRUE(needs_of(TaskKind(Orbit{})).endless);
}

TEST(TaskNeeds, KnowWhereATaskEndsAndTheWayHomeFromThere) {
  FollowLine line;
  line.points = {{0, 0}, {1000, 0}, {1000, 500}};
  const TaskNeeds needs = needs_of(TaskKind(line));
  EXPECT_EQ(needs.begin, Vec2(0, 0));
  EXPECT_EQ(needs.end, Vec2(1000, 500));
  TeamResources resources;
  resources.speed = 20;
  resources.home_north = 1000;
  resources.home_east = -500;
  FlightConditions conditions;
  EXPECT_DOUBLE_EQ(*time_home(needs, resources, conditions), 50);
  conditions.set_wind({0, 10});
  EXPECT_DOUBLE_EQ(*time_home(needs, resources, conditions), 100);
  EXPECT_DOUBLE_EQ(
      *time_home(needs_of(TaskKind(Measure{{1000, 1500}, 60})), resources, conditions),
      200);
}

TEST(TeamTask, CarriesWhatIsFlown) {
  const TeamTask task =
      team_task(4, Measure{{100, -200}, 45}, kCameraSensor, true, {2, 3});
  EXPECT_EQ(task.after, (std::vector<std::uint32_t>{2, 3}));
  EXPECT_EQ(task.number, 4u);
  EXPECT_EQ(task.sensors, kCameraSensor);
  EXPECT_FALSE(task.single);
  EXPECT_EQ(task.place, Vec2(100, -200));
  const auto what = unpacked(task);
  ASSERT_TRUE(what);
  EXPECT_EQ(std::get<Measure>(*what).stay, 45);
  TeamTask broken = task;
  broken.what.pop_back();
  EXPECT_FALSE(unpacked(broken));
  broken.what.clear();
  EXPECT_FALSE(unpacked(broken));
}

}  // namespace
}  // namespace skein::reasoning::task_needs_test
