// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "skein/layer/reasoning/mission/patrol/patrol_mission.h"
#include "skein/layer/reasoning/mission/survey/survey_mission.h"
#include "skein/layer/reasoning/mission/tasks/task_mission.h"
#include "skein/layer/reasoning/mission/track/track_mission.h"

namespace skein::reasoning::missions_test {
namespace {

// Aircraft that obey orders at once, and say what the test has them say.
struct Team {
  struct Aircraft {
    Task task;
    AircraftReport report;
    std::optional<TaskReport> left;
    bool silent = false, mine = true;
  };
  explicit Team(std::size_t count) : aircraft(count) {
    for (std::size_t k = 0; k < count; ++k) {
      aircraft[k].report.nav.p_N = {100.0 * static_cast<double>(k), 0, -100};
      aircraft[k].report.limits = FlightLimits();
    }
  }
  static std::vector<EntityId> ids(std::uint32_t count) {
    std::vector<EntityId> all;
    for (std::uint32_t k = 1; k <= count; ++k) all.push_back(EntityId{k});
    return all;
  }

  AgentOutput second(Mission& mission, const std::vector<Message>& more = {}) {
    std::vector<Message> inbox = more;
    for (std::uint32_t k = 0; k < aircraft.size(); ++k) {
      Aircraft& each = aircraft[k];
      if (each.silent) continue;
      each.report.obeys = each.mine;
      each.report.task_number = each.task.number;
      each.report.nav.time = now;
      inbox.push_back({EntityId{k + 1}, {}, 0, now, each.report});
      if (each.left) inbox.push_back({EntityId{k + 1}, {}, 0, now, *each.left});
    }
    AgentInput in;
    in.now = now += Time::from_seconds(1);
    in.inbox = inbox;
    AgentOutput out;
    mission.step(in, out);
    for (const Message& message : out.outbox) {
      const auto* task = std::get_if<Task>(&message.content);
      Aircraft& to = aircraft.at(message.to.value - 1);
      if (!task || task->number <= to.task.number) continue;
      to.task = *task;
      to.report.task_state = TaskState::kFlying;
      to.left.reset();
    }
    return out;
  }
  void seconds(Mission& mission, int count) {
    for (int k = 0; k < count; ++k) second(mission);
  }
  template <class T>
  const T* flies(std::size_t k) const {
    return std::get_if<T>(&aircraft[k].task.what);
  }

  std::vector<Aircraft> aircraft;
  Time now;
};

double length_of(const std::vector<Vec2>& lines) {
  double sum = 0;
  for (std::size_t k = 0; k + 1 < lines.size(); k += 2)
    sum += (lines[k + 1] - lines[k]).norm();
  return sum;
}

SurveyMissionOptions square_kilometre() {
  SurveyMissionOptions options;
  options.survey.area = {{0, 0}, {1000, 0}, {1000, 1000}, {0, 1000}};
  options.survey.swath = 100;
  return options;
}

TEST(SurveyMission, SharesLinesAmongAllAndIsDoneWhenTheyAre) {
  Team team(3);
  SurveyMission mission(Team::ids(3), square_kilometre());
  team.seconds(mission, 12);
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    ASSERT_TRUE(team.flies<Survey>(k));
    sum += length_of(team.flies<Survey>(k)->lines);
  }
  EXPECT_NEAR(sum, 10 * 1000, 1);
  EXPECT_FALSE(mission.done());
  for (auto& each : team.aircraft) each.report.task_state = TaskState::kDone;
  team.seconds(mission, 2);
  EXPECT_TRUE(mission.done());
}

TEST(SurveyMission, OthersGoOnWithWhatALostOneHasLeft) {
  Team team(2);
  SurveyMission mission(Team::ids(2), square_kilometre());
  team.seconds(mission, 12);
  // Of five lines the first has two and a half left.
  Survey left = *team.flies<Survey>(0);
  const double of_other = length_of(team.flies<Survey>(1)->lines);
  left.lines.erase(left.lines.begin(), left.lines.begin() + 4);
  left.lines.front() = (left.lines[0] + left.lines[1]) / 2;
  const double unseen = length_of(left.lines);
  ASSERT_GT(unseen, 1000);
  team.aircraft[0].left =
      TaskReport{team.aircraft[0].task.number, TaskState::kFlying, "", left};
  team.second(mission);
  team.aircraft[0].silent = true;
  team.seconds(mission, 10);
  EXPECT_NEAR(length_of(team.flies<Survey>(1)->lines), of_other + unseen, 1e-6);
  team.aircraft[1].report.task_state = TaskState::kDone;
  team.seconds(mission, 2);
  EXPECT_TRUE(mission.done());
}

TEST(SurveyMission, OneThatComesLaterGetsAShare) {
  Team team(2);
  team.aircraft[1].mine = false;
  SurveyMission mission(Team::ids(2), square_kilometre());
  team.seconds(mission, 12);
  EXPECT_EQ(team.aircraft[1].task.number, 0u);
  team.aircraft[1].mine = true;
  team.seconds(mission, 40);
  ASSERT_TRUE(team.flies<Survey>(1));
  EXPECT_NEAR(
      length_of(team.flies<Survey>(0)->lines) + length_of(team.flies<Survey>(1)->lines),
      10 * 1000, 1);
}

// Two aircraft of which one is done; the other is in the middle of its second line, at
// 20 m/s, with three more to come and `to_go` seconds left.
struct HalfDone {
  explicit HalfDone(double to_go) {
    team.seconds(mission, 12);
    left = *team.flies<Survey>(0);
    left.lines.erase(left.lines.begin(), left.lines.begin() + 2);
    auto& busy = team.aircraft[0];
    busy.left = TaskReport{busy.task.number, TaskState::kFlying, "", left};
    const Vec2 middle = (left.lines[0] + left.lines[1]) / 2;
    const Vec2 ahead = (left.lines[1] - left.lines[0]).normalized();
    busy.report.nav.p_N = {middle.x(), middle.y(), -100};
    busy.report.nav.v_N = {20 * ahead.x(), 20 * ahead.y(), 0};
    busy.report.nav.heading = geo::bearing(ahead);
    busy.report.task_time_to_go = to_go;
    before = busy.task.number;
    team.aircraft[1].report.nav.p_N = {left.lines[7].x(), left.lines[7].y(), -100};
    team.aircraft[1].report.task_state = TaskState::kDone;
  }
  Team team{2};
  SurveyMission mission{Team::ids(2), square_kilometre()};
  Survey left;
  std::uint32_t before = 0;
};

TEST(SurveyMission, WhoIsOnALineFliesItToItsEndBeforeItSharesTheRest) {
  HalfDone world(230);
  world.team.seconds(world.mission, 31);
  const auto* busy = world.team.flies<Survey>(0);
  ASSERT_TRUE(busy);
  EXPECT_GT(world.team.aircraft[0].task.number, world.before);
  ASSERT_GE(busy->lines.size(), 2u);
  // On from a little ahead of where it is, to the same end.
  EXPECT_EQ(busy->lines[1], world.left.lines[1]);
  const double ahead =
      (busy->lines[0] - geo::horizontal(world.team.aircraft[0].report.nav.p_N)).norm();
  EXPECT_GT(ahead, 40);
  EXPECT_LT(ahead, 80);
  // The other has been given some; all that is left is flown by somebody.
  EXPECT_GE(length_of(world.team.flies<Survey>(1)->lines), 1000 - 1);
  EXPECT_NEAR(length_of(busy->lines) + length_of(world.team.flies<Survey>(1)->lines),
              length_of(world.left.lines) - 500 - ahead, 1);
}

TEST(SurveyMission, DoesNotShareWhatIsSoonDone) {
  HalfDone world(60);  // 25 s on the line and more: nobody is much earlier
  world.left.lines.resize(4);
  world.team.aircraft[0].left->rest = world.left;
  world.team.aircraft[1].report.nav.p_N = {3000, 3000, -100};
  world.team.seconds(world.mission, 31);
  EXPECT_EQ(world.team.aircraft[0].task.number, world.before);
}

Message sighting(std::uint32_t from, std::uint32_t object, const Vec2& place, Time now) {
  return {EntityId{from}, {}, 0, now, ObjectSighting{object, now, place, 2}};
}

TEST(TrackMission, AsksForOneAircraftForEachObjectAndSendsTheNearest) {
  Team team(3);
  TrackMission mission(Team::ids(3), {});
  team.second(mission);
  EXPECT_EQ(mission.demand().max, 0);
  team.second(mission, {sighting(1, 7, {210, 0}, team.now)});
  EXPECT_EQ(mission.demand().min, 1);
  ASSERT_TRUE(team.flies<Orbit>(2));
  EXPECT_EQ(team.flies<Orbit>(2)->object, 7u);
  EXPECT_EQ(team.aircraft[0].task.number, 0u);
  // What others see of it is passed on; the tracker's own sightings are not.
  const auto passed_on = [&](std::uint32_t by) {
    const auto out = team.second(mission, {sighting(by, 7, {220, 0}, team.now)});
    return std::any_of(out.outbox.begin(), out.outbox.end(), [](const Message& m) {
      return m.to == EntityId{3} && std::holds_alternative<ObjectSighting>(m.content);
    });
  };
  EXPECT_TRUE(passed_on(1));
  EXPECT_FALSE(passed_on(3));
  // The tracker is lost: another.
  team.aircraft[2].silent = true;
  team.seconds(mission, 8);
  EXPECT_TRUE(team.flies<Orbit>(1));
}

TEST(TrackMission, GivesUpWhatNobodySeesAndLeavesOutWhatItIsNotAbout) {
  Team team(1);
  TrackMissionOptions options;
  options.objects = {4};
  options.lost_after = 20;
  TrackMission mission(Team::ids(1), options);
  team.second(mission, {sighting(1, 5, {0, 0}, team.now)});
  EXPECT_EQ(mission.demand().max, 0);
  team.second(mission, {sighting(1, 4, {0, 0}, team.now)});
  EXPECT_EQ(mission.demand().max, 1);
  team.seconds(mission, 25);
  EXPECT_EQ(mission.demand().max, 0);
}

TEST(PatrolMission, SendsItsAircraftOffOneAfterTheOther) {
  Team team(2);
  Patrol patrol;
  patrol.line = {{0, 0}, {2000, 0}};
  PatrolMission mission(Team::ids(2), patrol);
  team.second(mission);
  EXPECT_TRUE(team.flies<Patrol>(0));
  EXPECT_EQ(team.aircraft[1].task.number, 0u);
  // A round is twice 2 km at 20 m/s and two turns; half of that later the other follows.
  team.seconds(mission, 90);
  EXPECT_EQ(team.aircraft[1].task.number, 0u);
  team.seconds(mission, 40);
  EXPECT_TRUE(team.flies<Patrol>(1));
}

TEST(TaskMission, GivesEachTaskToTheNearestThatIsFreeAndGoesOnWhereOneWasLost) {
  Team team(2);
  TaskMission mission(Team::ids(2), {{FlyTo{{90, 0}}, {}},
                                     {FlyRoute{{{0, 0}, {500, 0}}, 3, {}}, {}},
                                     {Measure{{5, 5}, 10}, EntityId{2}}});
  team.second(mission);
  EXPECT_TRUE(team.flies<FlyTo>(1));
  EXPECT_TRUE(team.flies<FlyRoute>(0));
  EXPECT_EQ(mission.demand().max, 3);
  team.aircraft[1].report.task_state = TaskState::kDone;
  team.seconds(mission, 2);
  EXPECT_TRUE(team.flies<Measure>(1));
  team.aircraft[0].left = TaskReport{team.aircraft[0].task.number, TaskState::kFlying, "",
                                     FlyRoute{{{500, 0}}, 1, {}}};
  team.second(mission);
  team.aircraft[0].silent = true;
  team.aircraft[1].report.task_state = TaskState::kDone;
  team.seconds(mission, 8);
  ASSERT_TRUE(team.flies<FlyRoute>(1));
  EXPECT_EQ(team.flies<FlyRoute>(1)->laps, 1) << "what was left";
  EXPECT_FALSE(mission.done());
  team.aircraft[1].report.task_state = TaskState::kDone;
  team.seconds(mission, 2);
  EXPECT_TRUE(mission.done());
}

}  // namespace
}  // namespace skein::reasoning::missions_test
