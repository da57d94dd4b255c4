// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/trajectory/execution_monitor.h"

#include <gtest/gtest.h>

namespace skein::reasoning::execution_monitor_test {
namespace {

AutopilotStatus status(double time_error, double cross_track) {
  AutopilotStatus s;
  s.follows = true;
  s.time_error = time_error;
  s.cross_track = cross_track;
  return s;
}

TEST(SafetyZone, IsWiderBehindThanAhead) {
  const SafetyZone zone{2, 8, 20};
  EXPECT_TRUE(within(zone, {8, 0}));
  EXPECT_FALSE(within(zone, {8.1, 0}));
  EXPECT_TRUE(within(zone, {-2, 0}));
  EXPECT_FALSE(within(zone, {-2.1, 0}));
  EXPECT_TRUE(within(zone, {0, -20}));
  EXPECT_FALSE(within(zone, {0, -20.1}));
}

TEST(ExecutionMonitor, ReportsOnceWhenAnErrorLeavesItsRangeAndOnceWhenItIsBack) {
  ExecutionMonitor monitor(SafetyZone{2, 8, 20});
  const EntityId self{3};
  EXPECT_FALSE(monitor.check({}, self, status(7, 0)));
  const auto off = monitor.check({}, self, status(8.5, -3));
  ASSERT_TRUE(off);
  EXPECT_EQ(off->kind, EventKind::kOffPlan);
  EXPECT_EQ(off->text, "8.5 s behind the plan, 3.0 m off the path");
  EXPECT_EQ(off->entity, self);
  EXPECT_FALSE(monitor.check({}, self, status(9, 0)));
  EXPECT_FALSE(monitor.check({}, self, status(7, 0))) << "not yet well inside";
  const auto on = monitor.check({}, self, status(-0.5, 0));
  ASSERT_TRUE(on);
  EXPECT_EQ(on->kind, EventKind::kOnPlan);
  EXPECT_EQ(on->text, "0.5 s ahead of the plan, 0.0 m off the path");
}

TEST(ExecutionMonitor, SaysNothingOfTimeWhereThereIsNone) {
  ExecutionMonitor monitor(SafetyZone{2, 8, 20});
  EXPECT_EQ(monitor.check({}, {}, status(0, 30))->text, "30.0 m off the path");
}

TEST(ExecutionMonitor, JudgesOnlyWhatIsFollowed) {
  ExecutionMonitor monitor(SafetyZone{});
  AutopilotStatus s = status(100, 500);
  s.follows = false;
  EXPECT_FALSE(monitor.check({}, {}, s));
  s.follows = true;
  EXPECT_TRUE(monitor.check({}, {}, s));
  s.follows = false;
  EXPECT_FALSE(monitor.check({}, {}, s));
  EXPECT_FALSE(monitor.off_plan());
}

}  // namespace
}  // namespace skein::reasoning::execution_monitor_test
