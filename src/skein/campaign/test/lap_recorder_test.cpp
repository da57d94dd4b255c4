// SPDX-License-Identifier: Apache-2.0
#include "skein/campaign/batch/lap_recorder.h"

#include <gtest/gtest.h>

#include <cmath>

namespace skein::campaign::lap_recorder_test {
namespace {

constexpr EntityId kWing{3};

// North along a leg: at 15 m/s, `off` to the right of it; believed to be 0.5 m further
// right and a tenth of a second late.
struct Leg {
  LapRecorder recorder;
  AutopilotStatus status;
  double time = 0;

  Leg() { status.mode = FlightMode::kAuto; }

  void fly(double off, double aileron = 0) {
    VehicleState state;
    state.p_N = {15 * time, off, -101};
    state.v_N = {15, 0, 0};
    state.airspeed = 16;
    state.actuators[0] = aileron;
    recorder.record(TruthRecord{Time::from_seconds(time), kWing, state});
    NavEstimate nav;
    nav.time = Time::from_seconds(time - 0.1);
    nav.p_N = {15 * (time - 0.1), off + 0.5, -101};
    status.follows = true;
    status.along = {1, 0};
    status.cross_track = off + 0.5;
    status.altitude_msl = 100;
    status.airspeed = 14;
    recorder.record(EstimateRecord{kWing, nav, status});
    time += 0.25;
  }
};

TEST(LapRecorder, MeasuresEachCompletedLapAgainstTruthAndBelief) {
  Leg leg;
  for (int k = 0; k < 100; ++k) leg.fly(k < 90 ? 1 : -3);  // ten per cent are far off
  leg.status.lap = 1;
  for (int k = 0; k < 60; ++k) leg.fly(0, k % 2 * 0.1);
  std::map<std::string, double> figures;
  leg.recorder.add_figures(figures);
  EXPECT_EQ(figures.at("laps"), 1) << "the second is not over";
  EXPECT_FALSE(figures.contains("lap2_time_s"));
  leg.status.lap = 2;
  leg.fly(0);
  figures.clear();
  leg.recorder.add_figures(figures);
  EXPECT_EQ(figures.at("laps"), 2);
  EXPECT_NEAR(figures.at("lap1_cross_track_rms_m"), std::sqrt(0.9 + 0.1 * 9), 1e-9);
  EXPECT_NEAR(figures.at("lap1_cross_track_p95_m"), 3, 1e-9);
  EXPECT_NEAR(figures.at("lap1_believed_cross_track_rms_m"),
              std::sqrt(0.9 * 2.25 + 0.1 * 6.25), 1e-9);
  EXPECT_NEAR(figures.at("lap1_height_rms_m"), 1, 1e-9);
  EXPECT_NEAR(figures.at("lap1_airspeed_rms_mps"), 2, 1e-9);
  EXPECT_NEAR(figures.at("lap1_effort_deg_per_s"), 0, 1e-9);
  EXPECT_NEAR(figures.at("lap1_time_s"), 99 * 0.25, 1e-9);
  EXPECT_NEAR(figures.at("lap2_cross_track_rms_m"), 0, 1e-9);
  // 0.1 rad in 0.25 s, at all but the first of 60 samples.
  EXPECT_NEAR(figures.at("lap2_effort_deg_per_s"),
              geo::degrees(0.4) * std::sqrt(59.0 / 60), 1e-9);
}

TEST(LapRecorder, TakesTheFirstAircraftAndOnlyWhatFollowsTheRoute) {
  Leg leg;
  leg.fly(2);
  const VehicleState other;
  leg.recorder.record(TruthRecord{Time(), EntityId{4}, other});
  leg.recorder.record(EstimateRecord{EntityId{4}, {}, leg.status});
  leg.status.follows = false;
  NavEstimate nav;
  leg.recorder.record(EstimateRecord{kWing, nav, leg.status});
  // A circle where it waits.
  leg.status.follows = true;
  leg.status.mode = FlightMode::kGuided;
  leg.recorder.record(EstimateRecord{kWing, nav, leg.status});
  ASSERT_EQ(leg.recorder.samples().size(), 1u);
  EXPECT_NEAR(leg.recorder.samples()[0].cross_track, 2, 1e-12);
  EXPECT_NEAR(leg.recorder.samples()[0].on_route.norm(), 0, 1e-12);
  EXPECT_NEAR(leg.recorder.samples()[0].estimated, 2.5, 1e-12);
}

}  // namespace
}  // namespace skein::campaign::lap_recorder_test
