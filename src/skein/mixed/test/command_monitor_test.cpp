// SPDX-License-Identifier: Apache-2.0
#include "skein/mixed/command_monitor.h"

#include <gtest/gtest.h>

namespace skein::mixed::command_monitor_test {
namespace {

Time s(double seconds) {
  return Time::from_seconds(seconds);
}

// In guided flight with all that it needs.
CommandMonitor::Inputs well() {
  CommandMonitor::Inputs in;
  in.leads = in.guided = in.position = true;
  in.mode_name = "GUIDED";
  in.altitude_msl = 30;
  return in;
}

// What it says at last, after so long of this.
template <class Sent>
std::string after(CommandMonitor& monitor, double from, double seconds,
                  const CommandMonitor::Inputs& in, Sent&& sent) {
  std::string why;
  for (double t = from; t < from + seconds && why.empty(); t += 0.1) {
    sent(s(t));
    why = monitor.step(s(t), in);
  }
  return why;
}
void nothing(Time) {}

TEST(CommandMonitor, SaysNothingOfWhatIsWell) {
  CommandMonitor monitor;
  EXPECT_EQ(after(monitor, 0, 300, well(), nothing), "");
}

TEST(CommandMonitor, ReportsWhatLastsAndNotWhatIsShort) {
  CommandMonitor::Inputs in = well();
  in.guided = false;
  in.mode_name = "LOITER";
  CommandMonitor monitor;
  EXPECT_EQ(after(monitor, 0, 14, in, nothing), "");
  EXPECT_EQ(after(monitor, 14, 1, well(), nothing), "");
  EXPECT_EQ(after(monitor, 15, 14, in, nothing), "");
  EXPECT_EQ(after(monitor, 29, 5, in, nothing), "it stays in LOITER");
  monitor.forget();
  in = well();
  in.position = false;
  in.position_age = 21;
  EXPECT_EQ(after(monitor, 0, 20, in, nothing), "its last position is 21 s old");
}

TEST(CommandMonitor, IsSilentWhileSomebodyElseFlies) {
  CommandMonitor::Inputs in = well();
  in.leads = in.guided = in.position = false;
  CommandMonitor monitor;
  EXPECT_EQ(after(monitor, 0, 100, in, nothing), "");
}

TEST(CommandMonitor, ReportsAClimbThatHasStopped) {
  CommandMonitor::Inputs in = well();
  in.taking_off = true;
  in.guided = false;
  in.climbs_to = 100;
  CommandMonitor monitor;
  for (double t = 0; t < 60; t += 0.1) {
    in.altitude_msl = t;
    ASSERT_EQ(monitor.step(s(t), in), "") << t;
  }
  const std::string why = after(monitor, 60, 40, in, nothing);
  EXPECT_NE(why.find("stopped climbing at 60 m"), std::string::npos) << why;
}

TEST(CommandMonitor, ReportsTrackSetpointsThatAreNeverObeyed) {
  TrackSetpoint setpoint;
  setpoint.p_N = {100, 0, -30};
  setpoint.v_N = {6, 0, 0};
  VehicleMotion stands;
  stands.p_N = {0, 0, -30};
  CommandMonitor monitor;
  EXPECT_EQ(after(monitor, 0, 20, well(),
                  [&](Time now) { monitor.sent(now, setpoint, stands); }),
            "it does not obey its setpoints");
  // Once it has obeyed, a gust may hold it for some time.
  CommandMonitor obeyed;
  VehicleMotion goes = stands;
  goes.v_N = {6, 0, 0};
  obeyed.sent(s(0), setpoint, goes);
  const auto held = [&](Time now) { obeyed.sent(now, setpoint, stands); };
  EXPECT_EQ(after(obeyed, 0, 25, well(), held), "");
  EXPECT_NE(after(obeyed, 25, 10, well(), held), "");
}

TEST(CommandMonitor, ReportsBanksThatAreNeverObeyed) {
  const BankSetpoint right{0.5, 100, 0, 20};
  VehicleMotion level, banked;
  banked.q_NB = geo::from_euler({0.4, 0, 0});
  CommandMonitor monitor, well_flown;
  EXPECT_EQ(
      after(monitor, 0, 20, well(), [&](Time now) { monitor.sent(now, right, level); }),
      "it does not obey its setpoints");
  EXPECT_EQ(after(well_flown, 0, 60, well(),
                  [&](Time now) { well_flown.sent(now, right, banked); }),
            "");
}

}  // namespace
}  // namespace skein::mixed::command_monitor_test
