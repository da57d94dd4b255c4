// SPDX-License-Identifier: Apache-2.0
#include "app/serve/task_preview.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>

#include "skein/assemble/kinds/kinds_of.h"
#include "skein/scenario/scenario_file.h"

namespace skein::serve::task_preview_test {
namespace {

// Lit, guarded, among others, and lost soon: none of it matters for a task flown ahead.
constexpr const char* kScenario = R"(
name: previewed
duration_s: 600
environment: {terrain: flat, wind: {kind: uniform, speed_mps: 4, from_deg: 200}}
aircraft:
  - {name: other, count: 2}
  - name: scout
    count: 2
    failures: [{kind: lost, at_s: 5}]
missions: [{kind: perimeter, name: fire}]
)";

class TaskPreviewTest : public testing::Test {
 protected:
  TaskPreviewTest() {
    auto outcome =
        scenario::read_scenario_text(kScenario, "test", ".", assemble::kind_table());
    EXPECT_TRUE(outcome.scenario);
    scenario = *outcome.scenario;
  }
  hmi::PreviewOrder order(TaskKind what) const {
    hmi::PreviewOrder asked;
    asked.aircraft = "scout-2";
    asked.what = std::move(what);
    asked.time = Time::from_seconds(100);
    asked.now.id = EntityId{4};
    asked.now.north = 500;
    asked.now.east = -300;
    asked.now.altitude_msl = 150;
    asked.now.heading_deg = 90;
    asked.now.charge = 0.6F;
    return asked;
  }
  TaskPreview preview(const hmi::PreviewOrder& asked) const {
    return preview_task(scenario, kinds, asked, stop);
  }
  static Vec2 at(const PathPoint& point) { return {point.north, point.east}; }

  scenario::Scenario scenario;
  assemble::KindRegistry kinds;
  std::atomic<bool> stop = false;
};

TEST_F(TaskPreviewTest, LeadsFromWhereTheAircraftIsToWhereItIsDone) {
  const TaskPreview flown = preview(order(FlyTo{Vec2(500, 1700)}));
  EXPECT_EQ(flown.problem, "");
  EXPECT_TRUE(flown.done);
  ASSERT_GT(flown.path.points.size(), 10u);
  EXPECT_LT((at(flown.path.points.front()) - Vec2(500, -300)).norm(), 40);
  EXPECT_LT((at(flown.path.points.back()) - Vec2(500, 1700)).norm(), 150);
  EXPECT_NEAR(flown.length, 2000, 250);
  // 20 m/s in 4 m/s of wind.
  EXPECT_GT(flown.duration, 2000 / 25);
  EXPECT_LT(flown.duration, 2000 / 15);
  EXPECT_NEAR(flown.charge_left, 0.6 - flown.charge, 1e-6);
}

TEST_F(TaskPreviewTest, LeadsAroundZonesThatAreInForceNow) {
  hmi::PreviewOrder asked = order(FlyTo{Vec2(500, 1700)});
  Zone zone;
  zone.name = "wood";
  zone.area = Disc{Vec2(500, 700), 250};
  zone.until = 700;  // of the run, not of the preview
  asked.zones = {zone};
  const TaskPreview flown = preview(asked);
  EXPECT_TRUE(flown.done) << flown.problem;
  for (const PathPoint& point : flown.path.points)
    EXPECT_GT((at(point) - Vec2(500, 700)).norm(), 250) << point.ahead;
  asked.zones[0].until = 90;  // it is over
  EXPECT_LT(preview(asked).length, flown.length - 20);
}

TEST_F(TaskPreviewTest, TimesAreThoseOfTheRun) {
  const TaskPreview flown =
      preview(order(Rendezvous{Vec2(500, 1700), Time::from_seconds(100 + 300), {}}));
  EXPECT_EQ(flown.problem, "");
  double nearest = 1e9, when = 0;
  for (const PathPoint& point : flown.path.points)
    if (const double off = (at(point) - Vec2(500, 1700)).norm(); off < nearest) {
      nearest = off;
      when = point.ahead;
    }
  EXPECT_LT(nearest, 60);
  EXPECT_NEAR(when, 300, 20);  // in 300 s: at 400 s of the run
}

TEST_F(TaskPreviewTest, IsFlownAsHighAndFastAsWasCommanded) {
  hmi::PreviewOrder asked = order(FlyTo{Vec2(500, 3700)});
  const TaskPreview before = preview(asked);
  asked.flight = FlightChangeCommand{"scout-2", 200, 16};
  const TaskPreview after = preview(asked);
  EXPECT_TRUE(after.done) << after.problem;
  EXPECT_GT(after.duration, 1.1 * before.duration);
  EXPECT_NEAR(before.path.points.back().altitude_msl, 120, 10);
  EXPECT_NEAR(after.path.points.back().altitude_msl, 200, 10);
}

TEST_F(TaskPreviewTest, WhatCannotBeFlownOrForeseenIsSaid) {
  EXPECT_NE(preview(order(FollowEdge{true, Vec2::Zero(), {0, 1}})).problem, "");
  EXPECT_NE(preview(order(FollowLeader{EntityId{1}, Vec2(-40, 0)})).problem, "");
  hmi::PreviewOrder other = order(Hold{});
  other.aircraft = "scout-9";
  EXPECT_NE(preview(other).problem.find("scout-9"), std::string::npos);
  // Of no kind that anybody here flies.
  NamedTask unknown;
  unknown.kind = "dance";
  EXPECT_NE(preview(order(unknown)).problem.find("dance"), std::string::npos);
  unknown.needs.foreseen = false;
  EXPECT_NE(preview(order(unknown)).problem.find("sensed"), std::string::npos);
  // Nothing to see with.
  Orbit orbit;
  orbit.object = 0;
  EXPECT_NE(preview(order(orbit)).problem, "");
}

TEST_F(TaskPreviewTest, WithoutAnEndItIsLookedAheadHalfAnHour) {
  const TaskPreview flown =
      preview(order(Patrol{{Vec2(0, 0), Vec2(800, 0)}, false, 0, 0}));
  EXPECT_EQ(flown.problem, "");
  EXPECT_FALSE(flown.done);
  EXPECT_NEAR(flown.duration, 1800, 1);
  EXPECT_LE(flown.path.points.size(), 400u);
}

TEST_F(TaskPreviewTest, TheNewestQuestionOfEachIsAnswered) {
  std::mutex lock;
  std::condition_variable answered;
  std::vector<std::pair<hmi::ClientNumber, std::uint32_t>> answers;
  TaskPreviewer previewer(scenario, kinds,
                          [&](hmi::ClientNumber client, const TaskPreview& preview) {
                            const std::lock_guard guard(lock);
                            answers.emplace_back(client, preview.number);
                            answered.notify_one();
                          });
  const hmi::PreviewOrder asked = order(FlyTo{Vec2(500, 1700)});
  for (const std::uint32_t number : {1U, 2U, 3U, 4U}) previewer.ask(7, number, asked);
  previewer.ask(8, 1, asked);
  std::unique_lock guard(lock);
  const auto has = [&](hmi::ClientNumber client, std::uint32_t number) {
    return std::count(answers.begin(), answers.end(), std::pair(client, number)) == 1;
  };
  answered.wait_for(guard, std::chrono::seconds(60),
                    [&] { return has(7, 4) && has(8, 1); });
  EXPECT_TRUE(has(7, 4));
  EXPECT_TRUE(has(8, 1));
  EXPECT_FALSE(has(7, 2) || has(7, 3));
}

}  // namespace
}  // namespace skein::serve::task_preview_test
