// SPDX-License-Identifier: Apache-2.0
#include "skein/mixed/position_monitor.h"

#include <gtest/gtest.h>

namespace skein::mixed::position_monitor_test {
namespace {

// Flies north at 20 m/s and says so ten times a second.
struct Flight {
  Flight() { condition.on_ground = false; }

  void run(double seconds, bool fix = true) {
    for (int k = 0; k < 10 * seconds; ++k) {
      now = now + Time::from_seconds(0.1);
      north += 2;
      VehicleMotion motion;
      motion.time = now;
      motion.p_N = Vec3(north, 0, -50);
      motion.v_N = Vec3(20, 0, 0);
      condition.position = fix;
      if (speaks) position.hear(motion);
      position.step(now, condition, link_up, events);
    }
  }
  std::vector<EventLabel> kinds() const {
    std::vector<EventLabel> all;
    for (const VehicleEvent& event : events) all.push_back(event.kind);
    return all;
  }

  PositionMonitor position{45, Time::from_seconds(5)};
  VehicleCondition condition;
  std::vector<VehicleEvent> events;
  bool speaks = true, link_up = true;
  double north = 0;
  Time now;
};

using Kinds = std::vector<EventLabel>;

TEST(PositionMonitor, LosesAFixAndHasItBack) {
  Flight f;
  f.run(2);
  EXPECT_TRUE(f.position.is_good());
  f.run(20, false);
  f.north -= 200;  // it had drifted
  EXPECT_FALSE(f.position.is_good());
  EXPECT_FALSE(f.position.why().empty());
  f.run(0.5);
  EXPECT_FALSE(f.position.is_good()) << "it may go again";
  f.run(2);
  EXPECT_TRUE(f.position.is_good());
  EXPECT_TRUE(f.position.why().empty());
  EXPECT_EQ(f.kinds(), (Kinds{EventKind::kPositionLost, EventKind::kPositionBack}));
}

TEST(PositionMonitor, DoesNotFollowAJumpUntilItHasJumpedBack) {
  Flight f;
  f.run(2);
  f.north += 400;
  f.run(5);
  EXPECT_FALSE(f.position.is_good());
  f.north -= 400;
  f.run(5);
  EXPECT_TRUE(f.position.is_good());
  EXPECT_EQ(f.kinds(), (Kinds{EventKind::kPositionJumped, EventKind::kPositionBack}));
}

TEST(PositionMonitor, BelievesAJumpThatSomebodyAccepts) {
  Flight f;
  f.run(2);
  f.north -= 400;
  f.run(5);
  EXPECT_FALSE(f.position.is_good());
  f.position.accept();
  f.run(2);
  EXPECT_TRUE(f.position.is_good());
}

TEST(PositionMonitor, AGapInWhichItFlewOnIsNoJump) {
  Flight f;
  f.run(2);
  f.speaks = false;
  f.link_up = false;
  f.run(60);
  EXPECT_FALSE(f.position.is_good());
  f.speaks = f.link_up = true;
  f.run(5);
  EXPECT_TRUE(f.position.is_good());
  EXPECT_TRUE(f.events.empty()) << "the loss of its link says it";
}

TEST(PositionMonitor, SaysThatItIsOldWhileItsLinkIsUp) {
  Flight f;
  f.run(2);
  f.speaks = false;
  f.run(10);
  f.speaks = true;
  f.run(5);
  EXPECT_EQ(f.kinds(), (Kinds{EventKind::kPositionOld, EventKind::kPositionBack}));
}

TEST(PositionMonitor, AShiftOnTheGroundIsNone) {
  Flight f;
  f.condition.on_ground = true;
  f.run(2);
  f.north += 400;
  f.run(2);
  f.condition.on_ground = false;
  f.run(2);
  EXPECT_TRUE(f.position.is_good());
}

}  // namespace
}  // namespace skein::mixed::position_monitor_test
