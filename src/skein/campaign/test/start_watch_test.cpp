// SPDX-License-Identifier: Apache-2.0
#include "skein/campaign/ground_starts/start_watch.h"

#include <gtest/gtest.h>

#include "skein/geo/rotation.h"

namespace skein::campaign::start_watch_test {
namespace {

constexpr EntityId kAircraft{1};

// A start that climbs by 5 m/s to 80 m, which a test spoils.
struct Started {
  void fly(double seconds, double climb = 5) {
    for (int k = 0; k < static_cast<int>(10 * seconds + 0.5); ++k) {
      now += Time::from_seconds(0.1);
      state.p_N.z() = std::max(state.p_N.z() - 0.1 * climb, -80.0);
      nav.p_N = state.p_N + off;
      watch.record(TruthRecord{now, kAircraft, state});
      watch.record(EstimateRecord{kAircraft, nav, status});
    }
  }
  double figure(const std::string& name) const {
    std::map<std::string, double> figures;
    watch.add_figures(figures);
    return figures.at(name);
  }

  StartWatch watch{{.altitude_msl = 80}, kAircraft};
  VehicleState state;
  NavEstimate nav;
  AutopilotStatus status;
  Vec3 off = Vec3::Zero();  // of the estimate
  Time now;
};

TEST(StartWatch, AGoodStartIsNotLost) {
  Started start;
  start.fly(60);
  EXPECT_EQ(start.figure("lost"), 0);
  EXPECT_NEAR(start.figure("climb_time_s"), 14, 0.2);
}

TEST(StartWatch, WhatDoesNotClimbIsLost) {
  Started start;
  start.fly(60, 0);
  EXPECT_EQ(start.figure("lost_climb"), 1);
  EXPECT_EQ(start.figure("lost"), 1);
}

TEST(StartWatch, ABeliefThatLeavesTheTruthForASecondIsALoss) {
  Started tilted;
  tilted.fly(30);
  tilted.nav.roll = 0.4;
  tilted.fly(0.8);
  tilted.nav.roll = 0;
  tilted.fly(10);
  EXPECT_EQ(tilted.figure("lost"), 0);
  EXPECT_NEAR(tilted.figure("attitude_error_max_deg"), geo::degrees(0.4), 1e-6);
  tilted.nav.pitch = 0.4;
  tilted.fly(1.2);
  EXPECT_EQ(tilted.figure("lost_belief"), 1);
  Started low;
  low.fly(30);
  low.off = {0, 0, 30};
  low.fly(1.2);
  EXPECT_EQ(low.figure("lost_belief"), 1);
  EXPECT_EQ(low.figure("lost_tilt"), 0);
}

TEST(StartWatch, TiltFailsafesAndAccidentsAreLosses) {
  Started rolled;
  rolled.fly(30);
  rolled.state.q_NB = geo::from_euler({1.4, 0, 0});
  rolled.nav.roll = 1.4;
  rolled.fly(1.2);
  EXPECT_EQ(rolled.figure("lost_tilt"), 1);
  EXPECT_EQ(rolled.figure("lost_belief"), 0);
  Started failed;
  failed.fly(30);
  failed.status.reaction = FailsafeReaction::kHold;
  failed.fly(0.1);
  EXPECT_EQ(failed.figure("lost_failsafe"), 1);
  Started hit;
  hit.fly(30);
  hit.watch.record(Event{hit.now, EntityId{2}, EventKind::kAccident, ""});
  EXPECT_EQ(hit.figure("lost"), 0);
  hit.watch.record(Event{hit.now, kAircraft, EventKind::kAccident, ""});
  EXPECT_EQ(hit.figure("lost_accident"), 1);
}

}  // namespace
}  // namespace skein::campaign::start_watch_test
