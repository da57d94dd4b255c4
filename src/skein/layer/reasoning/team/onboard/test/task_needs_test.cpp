#include "skein/layer/reasoning/team/onboard/task_needs.h"

#include <gtest/gtest.h>

#include "skein/layer/reasoning/team/onboard/packed_task.h"

namespace skein::reasoning::task_needs_test {
namespace {

TEST(TimeInWind, IsThatOfTheGroundSpeedAlongTheLeg) {
  EXPECT_DOUBLE_EQ(*time_in_wind({1000, 0}, 20, {0, 0}), 50);
  EXPECT_DOUBLE_EQ(*time_in_wind({1000, 0}, 20, {5, 0}), 40);
  EXPECT_DOUBLE_EQ(*time_in_wind({1000, 0}, 20, {-10, 0}), 100);
  EXPECT_DOUBLE_EQ(*time_in_wind({1000, 0}, 20, {0, 12}), 1000.0 / 16);
  EXPECT_DOUBLE_EQ(*time_in_wind({0, 0}, 20, {30, 0}), 0);
  EXPECT_FALSE(time_in_wind({1000, 0}, 20, {-20, 0}));
  EXPECT_FALSE(time_in_wind({1000, 0}, 20, {0, 21}));
}

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
  EXPECT_DOUBLE_EQ(*time_within(needs, resources, {0, 0}), 8000.0 / 20);
  EXPECT_DOUBLE_EQ(*time_within(needs, resources, {0, 10}), 8000.0 * 20 / 300);
  EXPECT_FALSE(time_within(needs, resources, {0, 20}));
}

TEST(TaskNeeds, SayWhichSensorsATaskTakes) {
  Orbit object;
  object.object = 3;
  EXPECT_EQ(needs_of(TaskKind(object)).sensors, kCameraSensor);
  EXPECT_EQ(needs_of(TaskKind(Orbit{})).sensors, 0u);
  EXPECT_EQ(needs_of(TaskKind(FollowEdge{})).sensors, kFireSensor);
  EXPECT_TRUE(needs_of(TaskKind(Orbit{})).endless);
}

TEST(TeamTask, CarriesWhatIsFlown) {
  const TeamTask task = team_task(4, Measure{{100, -200}, 45}, kCameraSensor, true);
  EXPECT_EQ(task.number, 4u);
  EXPECT_EQ(task.sensors, kCameraSensor);
  EXPECT_FALSE(task.single);
  EXPECT_EQ(task.place, Vec3(100, -200, 0));
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
