// SPDX-License-Identifier: Apache-2.0
#include "skein/link/autopilot_client/telemetry.h"

#include <gtest/gtest.h>

#include <cmath>

namespace skein::autopilot_client::telemetry_test {
namespace {

// The motion that a vehicle is believed to have after it said this of its receiver.
VehicleMotion motion_with(const mavlink::GpsRawInt& receiver) {
  Telemetry telemetry(geo::LocalFrame::at({47.0, 8.0, 0}).value());
  telemetry.handle(receiver);
  mavlink::GlobalPositionInt position;
  position.lat = 470'000'000;
  position.lon = 80'000'000;
  position.alt = 500'000;
  return telemetry.handle(position, Time::from_seconds(1), ClockAlignment()).value();
}

// With a fix, and nothing said of how good it is.
mavlink::GpsRawInt receiver() {
  mavlink::GpsRawInt m;
  m.fix_type = 3;
  m.eph = 0xffff;
  m.epv = 0xffff;
  return m;
}

TEST(Telemetry, TakesTheAccuracyThatTheReceiverStates) {
  mavlink::GpsRawInt m = receiver();
  m.eph = 90;
  m.epv = 120;
  m.h_acc = 2000;  // [mm], of both axes together
  m.v_acc = 3500;
  const VehicleMotion motion = motion_with(m);
  EXPECT_NEAR(motion.position_sd, 2.0 / std::sqrt(2.0), 1e-9);
  EXPECT_NEAR(motion.altitude_sd, 3.5, 1e-9);
}

TEST(Telemetry, TakesTheDilutionWhereNoAccuracyIsStated) {
  mavlink::GpsRawInt m = receiver();
  m.eph = 90;
  m.epv = 150;
  const VehicleMotion motion = motion_with(m);
  EXPECT_NEAR(motion.position_sd, 1.8, 1e-9);
  EXPECT_NEAR(motion.altitude_sd, 3.0, 1e-9);
}

TEST(Telemetry, TakesTheAltitudeForLessSureThanThePlaceWhereNothingIsStated) {
  const VehicleMotion motion = motion_with(receiver());
  EXPECT_NEAR(motion.position_sd, 2, 1e-9);
  EXPECT_NEAR(motion.altitude_sd, 3, 1e-9);
}

TEST(Telemetry, FliesOnByDeadReckoningWithoutAFix) {
  Telemetry telemetry(geo::LocalFrame::at({47.0, 8.0, 0}).value());
  mavlink::GpsRawInt m = receiver();
  telemetry.handle(m);
  mavlink::GlobalPositionInt position;
  position.lat = 470'000'000;
  position.lon = 80'000'000;
  const auto said_at = [&](double t) {
    return telemetry.handle(position, Time::from_seconds(t), ClockAlignment());
  };
  EXPECT_NEAR(said_at(1)->position_sd, 2, 1e-9);
  EXPECT_TRUE(telemetry.condition().position);
  m.fix_type = 1;
  telemetry.handle(m);
  EXPECT_NEAR(said_at(11)->position_sd, 2 + 20, 1e-9) << "grows by 2 m/s";
  EXPECT_FALSE(telemetry.condition().position);
  m.fix_type = 3;
  telemetry.handle(m);
  EXPECT_NEAR(said_at(12)->position_sd, 2, 1e-9);
  EXPECT_TRUE(telemetry.condition().position);
}

TEST(Telemetry, KnowsNoPlaceBeforeAFix) {
  Telemetry telemetry(geo::LocalFrame::at({47.0, 8.0, 0}).value());
  mavlink::GpsRawInt m = receiver();
  m.fix_type = 1;
  telemetry.handle(m);
  mavlink::GlobalPositionInt position;
  EXPECT_FALSE(
      telemetry.handle(position, Time::from_seconds(1), ClockAlignment()).has_value());
}

}  // namespace
}  // namespace skein::autopilot_client::telemetry_test
