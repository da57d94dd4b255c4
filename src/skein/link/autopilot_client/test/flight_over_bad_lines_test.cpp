// SPDX-License-Identifier: Apache-2.0
// A whole flight as the near end of a link commands it, over lines from good to hardly
// usable.
#include <gtest/gtest.h>

#include "skein/link/autopilot_client/test/flight.h"

namespace skein::autopilot_client::flight_over_bad_lines_test {
namespace {

MissionUpload square(double altitude_msl) {
  MissionUpload upload;
  for (const auto& [north, east] : {std::pair(300, 0), {300, 300}, {0, 300}, {0, 0}}) {
    MissionItem item;
    item.p_N = {double(north), double(east), -altitude_msl};
    upload.items.push_back(item);
  }
  return upload;
}

void fly(const Identity& identity, const Trouble& trouble, unsigned seed) {
  Flight f(identity, trouble, seed);
  ASSERT_TRUE(f.wait(20, [&] { return f.changes[LinkChange::Kind::kUp] == 1; }));
  const double ground = f.paper.snapshot.ground_msl;

  ASSERT_EQ(f.request(ArmRequest{true, false}), Outcome::kAccepted);
  ASSERT_EQ(f.request(TakeOffRequest{ground + 60, 0.0}), Outcome::kAccepted);
  ASSERT_TRUE(f.wait(30, [&] { return -f.seen.p_N.z() > ground + 59; }));
  f.wait(3, [] { return false; });  // what it says is older than that

  // PX4 is guided only while setpoints come.
  const VehicleRequest setpoint =
      identity.hovers ? VehicleRequest(TrackSetpoint{
                            {400, -200, -ground - 80}, Vec3::Zero(), Vec3::Zero(), 0.0})
                      : VehicleRequest(BankSetpoint{0.2, ground + 80, 0, 20});
  ASSERT_TRUE(f.guide(setpoint));
  f.steer(setpoint, 10);
  EXPECT_GT(f.paper.obeyed["track"] + f.paper.obeyed["bank"], 40);

  ASSERT_EQ(f.request(square(ground + 60)), Outcome::kAccepted);
  ASSERT_EQ(f.paper.mission.size(), 4u);
  EXPECT_NEAR(f.paper.mission[1].p_N.y(), 300, 0.1);
  ASSERT_EQ(f.request(MissionStart{0}), Outcome::kAccepted);
  EXPECT_TRUE(f.wait(200, [&] { return f.finished; })) << "its progress is told";

  const Vec2 point(0, 0);
  ASSERT_EQ(f.request(LandRequest{point, ground, 0.0}), Outcome::kAccepted);
  EXPECT_TRUE(f.wait(60, [&] { return f.told.on_ground && !f.told.armed; }));
  EXPECT_EQ(f.changes[LinkChange::Kind::kUp], 1);
  EXPECT_EQ(f.changes[LinkChange::Kind::kRebooted], 0);
  EXPECT_EQ(f.changes[LinkChange::Kind::kDuplicate], 0);
  EXPECT_EQ(f.changes[LinkChange::Kind::kMismatch], 0);
  EXPECT_LT(f.oldest, 2 * (trouble.delay + trouble.jitter) + 0.2)
      << "telemetry is given the time when it was true";
}

TEST(AutopilotClient, FliesEveryVehicleOverEveryLine) {
  unsigned seed = 1;
  for (const Identity& identity :
       {Identity{Make::kArduPilot, false}, Identity{Make::kArduPilot, true},
        Identity{Make::kPx4, false}, Identity{Make::kPx4, true}})
    for (const Trouble& trouble : vehicle_services::troubles()) {
      SCOPED_TRACE(testing::Message()
                   << (identity.make == Make::kPx4 ? "PX4" : "ArduPilot")
                   << (identity.hovers ? ", hovers" : ", wing") << ", loss "
                   << trouble.loss << ", delay " << trouble.delay);
      fly(identity, trouble, seed++);
      if (testing::Test::HasFatalFailure()) return;
    }
}

}  // namespace
}  // namespace skein::autopilot_client::flight_over_bad_lines_test
