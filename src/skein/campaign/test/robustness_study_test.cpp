// SPDX-License-Identifier: Apache-2.0
#include "skein/campaign/robustness/robustness_study.h"

#include <gtest/gtest.h>

#include <set>

#include "skein/geo/rotation.h"

namespace skein::campaign::robustness_study_test {
namespace {

constexpr EntityId kAircraft{1};

// A level flight at 100 m that a test spoils.
struct Watched {
  explicit Watched(const Vec2* hover_at = nullptr)
      : watch({.stall = 7}, kAircraft, 100, hover_at) {
    state.p_N = {0, 0, -100};
    state.airspeed = 15;
    status.follows = true;
  }
  void fly(double seconds) {
    for (int k = 0; k < static_cast<int>(10 * seconds + 0.5); ++k) {
      now += Time::from_seconds(0.1);
      nav.p_N = state.p_N + off;
      watch.record(TruthRecord{now, kAircraft, state});
      watch.record(EstimateRecord{kAircraft, nav, status});
    }
  }
  double figure(const std::string& name) {
    std::map<std::string, double> figures;
    watch.add_figures(figures);
    return figures.at(name);
  }

  FlightWatch watch;
  VehicleState state;
  NavEstimate nav;
  AutopilotStatus status;
  Vec3 off = Vec3::Zero();  // of the estimate
  Time now;
};

TEST(FlightWatch, AGoodFlightIsNotLost) {
  Watched flight;
  flight.status.cross_track = 10;
  flight.fly(60);
  EXPECT_EQ(flight.figure("lost"), 0);
  EXPECT_NEAR(flight.figure("track_error_rms_m"), 10, 1e-9);
}

TEST(FlightWatch, TiltAndLackOfSpeedMustLast) {
  Watched flight;
  for (int k = 0; k < 5; ++k) {
    flight.state.q_NB = geo::from_euler({geo::radians(80), 0, 0});
    flight.state.airspeed = 6;
    flight.fly(0.9);
    flight.state.q_NB = Quat::Identity();
    flight.state.airspeed = 15;
    flight.fly(1);
  }
  EXPECT_EQ(flight.figure("lost"), 0);
  flight.state.q_NB = geo::from_euler({geo::kPi, 0, 0});
  flight.fly(1.2);
  EXPECT_EQ(flight.figure("lost_tilt"), 1);
  EXPECT_EQ(flight.figure("lost_slow"), 0);
  flight.state.q_NB = Quat::Identity();
  flight.state.airspeed = 6;
  flight.fly(2.2);
  EXPECT_EQ(flight.figure("lost_slow"), 1);
  EXPECT_NEAR(flight.figure("slow_longest_s"), 2.2, 0.11);
}

TEST(FlightWatch, HeightIsTrueAndThePlaceIncludesTheEstimatesError) {
  Watched flight;
  flight.off = {0, 40, 0};
  flight.status.cross_track = -25;
  flight.fly(1);
  EXPECT_EQ(flight.figure("lost_track"), 1);
  EXPECT_EQ(flight.figure("lost_height"), 0);
  flight.state.p_N.z() = -131;
  flight.fly(1);
  EXPECT_EQ(flight.figure("lost_height"), 1);
}

TEST(FlightWatch, AHoverIsHeldAgainstTheEndOfTheRoute) {
  const Vec2 end(3, 4);
  Watched flight(&end);
  flight.fly(1);
  flight.status.follows = false;
  flight.status.done = true;
  flight.fly(60);
  EXPECT_NEAR(flight.figure("track_error_max_m"), 5, 1e-9);
}

TEST(FlightWatch, AnAccidentIsALoss) {
  Watched flight;
  flight.fly(1);
  flight.watch.record(Event{flight.now, EntityId{2}, EventKind::kAccident, ""});
  EXPECT_EQ(flight.figure("lost"), 0);
  flight.watch.record(Event{flight.now, kAircraft, EventKind::kAccident, ""});
  EXPECT_EQ(flight.figure("lost"), 1);
}

}  // namespace
}  // namespace skein::campaign::robustness_study_test
