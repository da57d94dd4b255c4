// SPDX-License-Identifier: Apache-2.0
// A real vehicle that a pilot or a failsafe of its own takes while commands to it are
// repeated: whoever takes it keeps it.
#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

#include "skein/mixed/test/fake_run.h"

namespace skein::mixed::fake {
namespace {

class RealVehicleTakeover : public testing::TestWithParam<Make> {
 protected:
  bool ardupilot() const { return GetParam() == Make::kArduPilot; }
};

INSTANTIATE_TEST_SUITE_P(Makes, RealVehicleTakeover,
                         testing::Values(Make::kArduPilot, Make::kPx4),
                         [](const auto& each) {
                           return each.param == Make::kPx4 ? "px4" : "ardupilot";
                         });

// Heartbeats show what each command has done.
TEST_P(RealVehicleTakeover, WithoutAnyAcknowledgementItIsFlown) {
  FakeRun run(GetParam(), {.ack_loss = 1});
  run.run(90);
  EXPECT_GT(run.fake.setpoints, 300) << run.log_text();
  EXPECT_EQ(run.fake.take_offs, 1) << run.log_text();
  EXPECT_EQ(run.fake.arms, 1) << run.log_text();
  EXPECT_EQ(run.verdict(), "") << run.log_text();
  EXPECT_EQ(run.count(EventKind::kTakeOffDenied) + run.count(EventKind::kRequestDenied) +
                run.count(EventKind::kModeChanged) + run.count(EventKind::kPilotTookOver),
            0u)
      << run.log_text();
}

TEST_P(RealVehicleTakeover, OverABadLineItIsFlown) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    FakeRun run(GetParam(), {.ack_loss = 0.5, .command_loss = 0.5, .seed = seed});
    run.run(120);
    EXPECT_GT(run.fake.setpoints, 100) << run.log_text();
    EXPECT_EQ(run.count(EventKind::kModeChanged) + run.count(EventKind::kPilotTookOver),
              0u)
        << "seed " << seed << "\n"
        << run.log_text();
  }
}

// From the first request to the end of the climb, with all kinds of losses.
TEST_P(RealVehicleTakeover, AtRandomTimesIsKept) {
  int taken = 0, landed = 0;
  for (unsigned seed = 1; seed <= 250; ++seed) {
    std::mt19937 random(seed);
    const auto between = [&](double least, double greatest) {
      return std::uniform_real_distribution<double>(least, greatest)(random);
    };
    Faults faults;
    faults.seed = seed;
    faults.ack_loss = between(0, 1) < 0.5 ? 1 : between(0, 1);
    faults.command_loss = between(0, 0.4);
    FakeRun run(GetParam(), faults);
    std::vector<VehicleMode> modes = {VehicleMode::kReturn, VehicleMode::kLand};
    // The mode that it is in before is not seen as a change.
    modes.push_back(ardupilot() ? VehicleMode::kHold : VehicleMode::kStabilized);
    const VehicleMode to =
        modes[std::uniform_int_distribution<std::size_t>(0, modes.size() - 1)(random)];
    run.run(between(8.2, 30));
    const bool in_air = !run.fake.on_ground();
    run.fake.change_mode(to);
    run.run(45);
    SCOPED_TRACE("seed " + std::to_string(seed) + "\n" + run.log_text());
    if (run.fake.crossed > 0) continue;
    const bool held = !run.vehicle->status().held.empty();
    // On the ground it is nobody's where it was asked for nothing in that moment.
    if (in_air || held) {
      EXPECT_EQ(run.fake.overridden, 0);
    }
    if (!in_air) {
      landed += held;
      continue;
    }
    ++taken;
    EXPECT_EQ(run.fake.mode(), to);
    EXPECT_TRUE(run.vehicle->status().reaction != FailsafeReaction::kNone ||
                run.vehicle->status().mode == FlightMode::kStabilized);
  }
  EXPECT_GT(taken, 60);
  EXPECT_GT(landed, 10);
}

// Its take-off is under way: whoever changes the mode on the ground has it too.
TEST_P(RealVehicleTakeover, OnTheGroundIsKeptWhileItIsToTakeOff) {
  const VehicleMode to = ardupilot() ? VehicleMode::kHold : VehicleMode::kStabilized;
  FakeRun run(GetParam(), {.command_loss = 1});
  run.run(9.5);
  run.fake.change_mode(to);
  run.run(1.5);
  run.fake.faults.command_loss = 0;
  run.run(40);
  EXPECT_EQ(run.fake.mode(), to) << run.log_text();
  EXPECT_FALSE(run.fake.armed) << run.log_text();
  EXPECT_EQ(run.count(EventKind::kModeChanged) + run.count(EventKind::kPilotTookOver), 1u)
      << run.log_text();
  run.fake.change_mode(VehicleMode::kGuided);  // the pilot gives it back
  run.run(60);
  EXPECT_TRUE(run.fake.flew) << run.log_text();
}

// It is being brought back when its pilot decides otherwise.
TEST_P(RealVehicleTakeover, WhileItIsBroughtBackIsKept) {
  for (unsigned seed = 1; seed <= 40; ++seed) {
    std::mt19937 random(seed);
    FakeRun run(GetParam(), {.ignores_setpoints = true, .ack_loss = 1, .seed = seed});
    run.run(30);
    run.fake.faults.command_loss = 1;  // from here on nothing arrives
    for (int k = 0; k < 600 && run.count(EventKind::kNotCommandable) == 0; ++k)
      run.run(0.1);
    ASSERT_EQ(run.count(EventKind::kNotCommandable), 1u) << run.log_text();
    run.run(std::uniform_real_distribution<double>(0.2, 5.5)(random));
    const VehicleMode to = ardupilot() ? VehicleMode::kHold : VehicleMode::kStabilized;
    run.fake.change_mode(to);
    run.fake.faults.command_loss = 0;
    run.run(30);
    EXPECT_EQ(run.fake.overridden, 0) << "seed " << seed << "\n" << run.log_text();
    // A first command that was under way may have been quicker than the heartbeat.
    EXPECT_TRUE(run.fake.mode() == to || run.fake.mode() == VehicleMode::kLand)
        << "seed " << seed << "\n"
        << run.log_text();
  }
}

}  // namespace
}  // namespace skein::mixed::fake
