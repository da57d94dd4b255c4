// SPDX-License-Identifier: Apache-2.0
#include "skein/link/autopilot_client/preflight_check.h"

#include <gtest/gtest.h>

#include <functional>

namespace skein::autopilot_client::preflight_check_test {
namespace {

// A multirotor that may take off.
PreflightInputs ready() {
  PreflightInputs in;
  in.type = 2;
  in.hovers = true;
  in.start.emplace();
  in.quality.receiver = true;
  in.quality.fix = 3;
  in.quality.satellites = 12;
  in.quality.hdop = 0.9;
  in.position = Vec3(3, 4, -2);
  in.position_rate = 10;
  in.home = Vec3(0, 0, 0);
  in.charge = 0.9;
  return in;
}

TEST(PreflightCheck, PassesWhatIsReady) {
  const PreflightResult result = check_preflight(ready());
  EXPECT_EQ(result.failed, 0u);
  EXPECT_EQ(result.text, "");
}

TEST(PreflightCheck, NamesEachItemThatFailsAndWhy) {
  using Inputs = PreflightInputs;
  struct Case {
    std::function<void(Inputs&)> make;
    const char* says;
  };
  const Case cases[] = {
      {[](Inputs& in) { in.type = 10; }, "identity: MAV_TYPE 10 is no multirotor"},
      {[](Inputs& in) { in.hovers = false; }, "identity: MAV_TYPE 2 is no fixed wing"},
      {[](Inputs& in) { in.emergency = true; },
       "health: it reports state critical or emergency"},
      {[](Inputs& in) { in.position_age = 1.8e9; },
       "clock: its positions are 1800000000.0 s old when they come in, 2 s are allowed"},
      {[](Inputs& in) { in.since_clock = 3; }, "clock: it was set less than 10 s ago"},
      {[](Inputs& in) { in.since_jump = 3; }, "position: it jumped less than 10 s ago"},
      {[](Inputs& in) { in.quality.fix = 2; },
       "position: it has no 3D fix (GPS_FIX_TYPE 2)"},
      {[](Inputs& in) { in.quality.satellites = 4; },
       "position: 4 satellites, 6 are needed"},
      {[](Inputs& in) { in.quality.hdop = 4; },
       "position: its dilution (eph) is 4.0, 2.5 is allowed"},
      {[](Inputs& in) { in.quality.sd = 30; },
       "position: its error is 30 m, 10 m are allowed"},
      {[](Inputs& in) { in.origin = true; },
       "position: it says latitude and longitude 0"},
      {[](Inputs& in) { in.position = Vec3(111'200, 0, 0), in.home = in.position; },
       "place: it is 111.2 km from its start, 500 m are allowed "
       "(vehicle.max_start_distance_m)"},
      {[](Inputs& in) { in.position = Vec3(0, 0, 60), in.home = in.position; },
       "place: its altitude is 60 m below that of its start, 30 m are allowed "
       "(vehicle.max_start_height_error_m)"},
      {[](Inputs& in) { in.home.reset(); }, "home: not known (no HOME_POSITION)"},
      {[](Inputs& in) { in.home = Vec3(0, 2000, 0); },
       "home: it is 1996 m away from the vehicle, 500 m are allowed"},
      {[](Inputs& in) { in.position_rate = 0.4; },
       "telemetry: 0.4 positions a second (GLOBAL_POSITION_INT), 1 is needed"},
      {[](Inputs& in) { in.since_heartbeat = 5; }, "link: no heartbeat for 5.0 s"},
      {[](Inputs& in) { in.round_trip = 3; },
       "link: a round trip takes 3.0 s, 2 s are allowed"},
      {[](Inputs& in) { in.charge = 0.15; },
       "energy: its battery has 15 %, 20 % are needed"},
  };
  for (const Case& each : cases) {
    PreflightInputs in = ready();
    each.make(in);
    EXPECT_EQ(check_preflight(in).text, each.says);
  }
}

TEST(PreflightCheck, ReportsAllThatFail) {
  PreflightInputs in = ready();
  in.charge = 0.1;
  in.home.reset();
  const PreflightResult result = check_preflight(in);
  EXPECT_EQ(result.text,
            "home: not known (no HOME_POSITION); energy: its battery has 10 %, 20 % are "
            "needed");
  in.charge = 0.09;
  EXPECT_EQ(check_preflight(in).failed, result.failed);
}

TEST(PreflightCheck, TakesAnEstimatorWhereThereIsNoReceiver) {
  PreflightInputs in = ready();
  in.quality = {};
  EXPECT_NE(check_preflight(in).text.find("position: nothing says how good it is"),
            std::string::npos);
  in.quality.estimator = 16;  // absolute position
  EXPECT_EQ(check_preflight(in).text, "");
  in.quality.estimator = 128;  // constant position
  EXPECT_NE(check_preflight(in).text.find("flags 0x80"), std::string::npos);
  in.quality.receiver = true;  // there, and says that there is none: GPS_FIX_TYPE 0
  in.quality.estimator = 16;
  EXPECT_EQ(check_preflight(in).text, "");
  in.quality.fix = 1;
  EXPECT_NE(check_preflight(in).text, "");
}

TEST(PreflightCheck, SaysNothingOfWhatTheVehicleDoesNotSay) {
  PreflightInputs in = ready();
  in.charge.reset();
  in.quality.satellites.reset();
  in.quality.hdop.reset();
  EXPECT_EQ(check_preflight(in).text, "");
}

}  // namespace
}  // namespace skein::autopilot_client::preflight_check_test
