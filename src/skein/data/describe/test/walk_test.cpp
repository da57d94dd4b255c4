// SPDX-License-Identifier: Apache-2.0
#include "skein/data/describe/walk.h"

#include <gtest/gtest.h>

#include <limits>

#include "skein/data/radio/message.h"
#include "skein/data/vehicle/entity_report.h"

namespace skein::walk::walk_test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
const Time kHour = Time::from_seconds(3600);

TEST(ShiftTimes, MovesAllPointsInTimeAndNothingElse) {
  AircraftReport report;
  report.nav.time = Time::from_seconds(5);
  report.task_time_to_go = 7;
  Message message{EntityId{1}, EntityId{2}, 3, Time::from_seconds(6), report};
  shift_times(message, kHour);
  EXPECT_EQ(message.sent, Time::from_seconds(3606));
  const auto& moved = std::get<AircraftReport>(message.content);
  EXPECT_EQ(moved.nav.time, Time::from_seconds(3605));
  EXPECT_EQ(moved.task_time_to_go, 7) << "a span";
}

TEST(ShiftTimes, MovesTheTimesOfZonesAndPlans) {
  ZoneChange change;
  change.zone.from = 100;
  shift_times(change, kHour);
  EXPECT_EQ(change.zone.from, 3700);
  EXPECT_EQ(change.zone.until, kInfinity);
  Task task{1, FlyPlan{{FlightElement{.start = 10, .duration = 4}}, false}};
  shift_times(task, kHour);
  const FlightElement& element = std::get<FlyPlan>(task.what).plan[0];
  EXPECT_EQ(element.start, 3610);
  EXPECT_EQ(element.duration, 4);
  Rendezvous meeting;
  meeting.time = Time::from_seconds(60);
  task.what = meeting;
  shift_times(task, kHour);
  EXPECT_EQ(std::get<Rendezvous>(task.what).time, Time::from_seconds(3660));
}

TEST(ShiftTimes, GoesNoFurtherThanTimesDo) {
  Time late = Time::from_ns(std::numeric_limits<std::int64_t>::max() - 1);
  shift_times(late, kHour);
  EXPECT_EQ(late.ns(), std::numeric_limits<std::int64_t>::max());
  Time early = Time::from_ns(std::numeric_limits<std::int64_t>::min() + 1);
  shift_times(early, Time::from_seconds(-1));
  EXPECT_EQ(early.ns(), std::numeric_limits<std::int64_t>::min());
}

TEST(SoundNumbers, AreNumbersAndFiniteVectors) {
  EntitySaying saying = RemoteState();
  EXPECT_TRUE(has_sound_numbers(saying));
  std::get<RemoteState>(saying).nav.position_sd = kInfinity;  // not known
  EXPECT_TRUE(has_sound_numbers(saying));
  std::get<RemoteState>(saying).nav.heading = kNone;
  EXPECT_FALSE(has_sound_numbers(saying));
  RemoteState state;
  state.nav.p_N.x() = kInfinity;
  saying = state;
  EXPECT_FALSE(has_sound_numbers(saying));
  state = {};
  state.truth.emplace().q_NB = Quat(2, 0, 0, 0);
  saying = state;
  EXPECT_FALSE(has_sound_numbers(saying)) << "no turn";
}

}  // namespace
}  // namespace skein::walk::walk_test
