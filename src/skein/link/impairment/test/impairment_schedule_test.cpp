// SPDX-License-Identifier: Apache-2.0
#include "skein/link/impairment/impairment_schedule.h"

#include <gtest/gtest.h>

namespace skein::impairment::impairment_schedule_test {
namespace {

TEST(ImpairmentSchedule, ChangesInOrderOfTime) {
  ImpairmentPlan plan;
  plan.first[0].loss = 0.1;
  plan.first[1].loss = 0.1;
  plan.changes.push_back({Time::from_seconds(20), Directions::kBoth, {.loss = 0.0}});
  plan.changes.push_back({Time::from_seconds(10), Directions::kToB, {.loss = 0.5}});
  ImpairmentSchedule schedule(plan);
  EXPECT_EQ(schedule.next(), Time::from_seconds(10));
  schedule.step();
  EXPECT_EQ(schedule.in_force(Direction::kToB).loss, 0.5);
  EXPECT_EQ(schedule.in_force(Direction::kToA).loss, 0.1);
  EXPECT_EQ(schedule.next(), Time::from_seconds(20));
  schedule.step();
  EXPECT_EQ(schedule.in_force(Direction::kToB).loss, 0.0);
  EXPECT_EQ(schedule.next(), std::nullopt);
}

TEST(ImpairmentSchedule, TakesBackWhatWasChangedByHand) {
  ImpairmentPlan plan;
  plan.changes.push_back({Time::from_seconds(10), Directions::kBoth, {.loss = 0.5}});
  ImpairmentSchedule schedule(plan);
  schedule.change(Directions::kToA, {.delay = 2.0, .loss = 0.9});
  EXPECT_EQ(schedule.in_force(Direction::kToA).delay, 2);
  EXPECT_EQ(schedule.in_force(Direction::kToB).delay, 0);
  schedule.step();
  EXPECT_EQ(schedule.in_force(Direction::kToA).loss, 0.5) << "the plan goes on";
  EXPECT_EQ(schedule.in_force(Direction::kToA).delay, 2);
  schedule.reset();
  EXPECT_EQ(schedule.in_force(Direction::kToA).delay, 0);
  EXPECT_EQ(schedule.in_force(Direction::kToA).loss, 0.5);
}

}  // namespace
}  // namespace skein::impairment::impairment_schedule_test
