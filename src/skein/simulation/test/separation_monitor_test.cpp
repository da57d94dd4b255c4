// SPDX-License-Identifier: Apache-2.0
#include "skein/simulation/separation_monitor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "skein/base/random.h"

namespace skein::simulation::separation_monitor_test {
namespace {

struct Flying {
  Vec3 p_N, v_N = Vec3::Zero();
  bool on_ground = false;
};

// Flies straight for some time and gathers what was seen.
class Watched {
 public:
  explicit Watched(std::vector<Flying> all)
      : all_(std::move(all)), monitor_(all_.size()) {}

  SeparationMonitor& monitor() { return monitor_; }
  Flying& operator[](std::size_t k) { return all_[k]; }

  void fly(double seconds, double step = 0.1) {
    for (int k = 0; k < std::lround(seconds / step); ++k) {
      now_ += Time::from_seconds(step);
      for (std::uint32_t i = 0; i < all_.size(); ++i) {
        all_[i].p_N += step * all_[i].v_N;
        monitor_.place(EntityId{i}, all_[i].p_N, all_[i].v_N, all_[i].on_ground);
      }
      monitor_.look(now_);
      begun.insert(begun.end(), monitor_.begun().begin(), monitor_.begun().end());
      over.insert(over.end(), monitor_.over().begin(), monitor_.over().end());
    }
  }

  std::vector<SeparationLossRecord> begun, over;

 private:
  std::vector<Flying> all_;
  SeparationMonitor monitor_;
  Time now_;
};

Message sent(std::uint32_t from, std::uint32_t to, MessageContent content) {
  return {EntityId{from}, EntityId{to}, 0, Time(), std::move(content)};
}

TEST(SeparationMonitor, OneEncounterIsOneLossWithItsLeastDistance) {
  Watched pair({{{-300, 0, -100}, {20, 0, 0}}, {{300, 30, -104}, {-20, 0, 0}}});
  pair.fly(60);
  ASSERT_EQ(pair.begun.size(), 1u);
  ASSERT_EQ(pair.over.size(), 1u);
  const SeparationLossRecord& loss = pair.over[0];
  EXPECT_EQ(loss.phase, SeparationPhase::kAir);
  EXPECT_EQ(loss.id, EntityId{0});
  EXPECT_EQ(loss.other, EntityId{1});
  EXPECT_TRUE(loss.over);
  EXPECT_NEAR(loss.ratio, 0.6, 1e-6) << "30 m of 50 m, abeam";
  EXPECT_NEAR(loss.distance, std::hypot(30, 4), 1e-3);
  EXPECT_NEAR(loss.closest.seconds(), 15, 1e-3);
  // 40 m along and 30 m across are 50 m.
  EXPECT_NEAR(loss.begun.seconds(), 14, 0.11);
  EXPECT_GT(loss.time, loss.closest);
}

TEST(SeparationMonitor, SeesWhatHappensBetweenTwoMoments) {
  Watched pair({{{-300, 0, -100}, {100, 0, 0}}, {{300, 1, -100}, {-100, 0, 0}}});
  pair.fly(20, 2.0);
  ASSERT_EQ(pair.over.size(), 1u);
  EXPECT_NEAR(pair.over[0].distance, 1, 1e-3);
}

TEST(SeparationMonitor, WhoStaysAtTheBorderLosesSeparationOnce) {
  Watched pair({{{0, 0, -100}}, {{52, 0, -100}}});
  for (int k = 0; k < 20; ++k) {
    pair[1].v_N = Vec3(k % 2 == 0 ? -1 : 1, 0, 0);
    pair.fly(5);
  }
  EXPECT_EQ(pair.begun.size(), 1u);
  EXPECT_TRUE(pair.over.empty());
  pair.monitor().finish(Time::from_seconds(100));
  ASSERT_EQ(pair.monitor().over().size(), 1u);
  EXPECT_FALSE(pair.monitor().over()[0].over);
}

TEST(SeparationMonitor, APairKeepsTheLargerOfWhatBothSay) {
  Watched pair({{{0, 0, -100}}, {{150, 0, -100}}});
  pair.fly(1);
  EXPECT_TRUE(pair.begun.empty());
  PlanReport wide;
  wide.horizontal = 200;
  wide.vertical = 60;
  pair.monitor().listen(sent(1, kEveryone.value, wide));
  pair.fly(1);
  ASSERT_EQ(pair.begun.size(), 1u);
  EXPECT_EQ(pair.begun[0].required_horizontal, 200);
  EXPECT_TRUE(pair.monitor().keeps_apart(EntityId{1}));
  EXPECT_FALSE(pair.monitor().keeps_apart(EntityId{0}));
}

TEST(SeparationMonitor, MembersOfAFormationMayBeNearButNotTouch) {
  Watched three({{{0, 0, -100}}, {{-40, -20, -100}}, {{-40, 20, -100}}});
  const auto follows = [](std::uint32_t who) {
    return sent(9, who, Task{1, FollowLeader{EntityId{0}, Vec2(-40, 0)}});
  };
  three.monitor().listen(follows(1));
  three.monitor().listen(follows(2));
  three.fly(5);
  EXPECT_TRUE(three.begun.empty());
  three[1].v_N = Vec3(0, 1, 0);
  three.fly(39.9);
  ASSERT_EQ(three.begun.size(), 1u);
  EXPECT_EQ(three.begun[0].phase, SeparationPhase::kFormation);
  // Another task ends its membership.
  three[1].v_N = Vec3::Zero();
  three[1].p_N = Vec3(-40, -20, -100);
  three.fly(20);
  const std::size_t before = three.begun.size();
  three.monitor().listen(sent(9, 1, Task{2, Loiter{}}));
  three.fly(1);
  EXPECT_EQ(three.begun.size(), before + 2) << "20 m and 45 m to two others";
}

TEST(SeparationMonitor, OnTheGroundWhoRollsMayNotTouchWhoStands) {
  Watched pair({{{0, 0, 0}, {0, 0, 0}, true}, {{3, 0, 0}, {0, 0, 0}, true}});
  pair.fly(5);
  EXPECT_TRUE(pair.begun.empty()) << "both stand";
  pair[1].p_N = Vec3(-40, 0.3, 0);
  pair.fly(1);
  pair[1].v_N = Vec3(10, 0, 0);
  pair.fly(8);
  ASSERT_EQ(pair.begun.size(), 1u);
  EXPECT_EQ(pair.begun[0].phase, SeparationPhase::kGround);
  pair.fly(20);
  ASSERT_EQ(pair.over.size(), 1u);
  EXPECT_NEAR(pair.over[0].distance, 0.3, 0.01);
}

TEST(SeparationMonitor, WhoIsNoLongerThereEndsItsEncounters) {
  SeparationMonitor monitor(2);
  const auto look = [&](int k, bool both) {
    monitor.place(EntityId{0}, Vec3(0, 0, -100), Vec3::Zero(), false);
    if (both) monitor.place(EntityId{1}, Vec3(10, 0, -100), Vec3::Zero(), false);
    monitor.look(Time::from_seconds(k));
  };
  look(1, true);
  EXPECT_EQ(monitor.begun().size(), 1u);
  look(2, false);
  ASSERT_EQ(monitor.over().size(), 1u);
  EXPECT_FALSE(monitor.over()[0].over);
}

// By all pairs at all steps.
TEST(SeparationMonitor, MissesNoPairOfACrowd) {
  RandomStream random(7, 0, Purpose::kTest);
  const auto within = [&](double most) { return most * (2 * random.uniform() - 1); };
  for (int run = 0; run < 20; ++run) {
    std::vector<Flying> crowd(60);
    for (Flying& each : crowd) {
      each.p_N = Vec3(within(700), within(run % 2 == 0 ? 700 : 5), within(30));
      each.v_N = Vec3(within(30), within(30), 0);
    }
    Watched watched(crowd);
    watched.fly(1, 1);
    std::map<std::pair<std::uint32_t, std::uint32_t>, double> expected;
    for (std::uint32_t i = 0; i < crowd.size(); ++i)
      for (std::uint32_t j = i + 1; j < crowd.size(); ++j) {
        // Of one moment only, as nobody was anywhere before it.
        const Vec3 apart = crowd[i].p_N + crowd[i].v_N - crowd[j].p_N - crowd[j].v_N;
        const double ratio =
            Separation{}.ratio(apart.head<2>().norm(), std::abs(apart.z()));
        if (ratio < 1) expected[{i, j}] = ratio;
      }
    ASSERT_EQ(watched.begun.size(), expected.size()) << "run " << run;
    for (const SeparationLossRecord& loss : watched.begun)
      EXPECT_NEAR(loss.ratio, expected.at({loss.id.value, loss.other.value}), 1e-9);
  }
}

}  // namespace
}  // namespace skein::simulation::separation_monitor_test
