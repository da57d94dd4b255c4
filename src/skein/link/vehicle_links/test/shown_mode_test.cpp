// SPDX-License-Identifier: Apache-2.0
#include "skein/link/vehicle_links/shown_mode.h"

#include <gtest/gtest.h>

namespace skein::vehicle_links::shown_mode_test {
namespace {

// The mode shown once a take-off to 30 m has ended.
VehicleMode after_take_off(bool stays_guided) {
  ShownMode shown(true, stays_guided);
  shown.hear(ModeRequest{VehicleMode::kGuided});
  shown.hear(ArmRequest{});
  shown.hear(TakeOffRequest{30, {}});
  AutopilotStatus status;
  status.on_ground = false;
  shown.hear(Time::from_seconds(1), status, 10);
  EXPECT_EQ(shown.mode(), VehicleMode::kTakeOff);
  shown.hear(Time::from_seconds(2), status, 29);
  return shown.mode();
}

TEST(ShownMode, AnArduCopterStaysGuidedAfterItsTakeOff) {
  EXPECT_EQ(after_take_off(true), VehicleMode::kGuided);
}

TEST(ShownMode, OthersHoldWhereTheirTakeOffEnded) {
  EXPECT_EQ(after_take_off(false), VehicleMode::kHold);
}

}  // namespace
}  // namespace skein::vehicle_links::shown_mode_test
