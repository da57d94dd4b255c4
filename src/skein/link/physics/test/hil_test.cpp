// SPDX-License-Identifier: Apache-2.0
#include "skein/link/physics/hil.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace skein::physics::hil_test {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST(HilSensorMessages, HaveTheUnitsOfTheirFields) {
  HilSensors sensors;
  sensors.time = Time::from_ns(4'000'999);
  sensors.unit = 2;
  sensors.imu = HilImu{{0.5, -0.25, -9.75}, {0.125, -0.5, 2}};
  sensors.field_B_gauss = Vec3(0.25, 0.0625, 0.375);
  sensors.barometer = HilBarometer{95'460, 500, 284.9};
  sensors.pitot_pressure = 245.0;
  const mavlink::HilSensor m = message_of(sensors);
  EXPECT_EQ(m.time_usec, 4000U);
  EXPECT_EQ(m.id, 2);
  EXPECT_EQ(m.xacc, 0.5F);
  EXPECT_EQ(m.yacc, -0.25F);
  EXPECT_EQ(m.zacc, -9.75F);
  EXPECT_EQ(m.xgyro, 0.125F);
  EXPECT_EQ(m.ygyro, -0.5F);
  EXPECT_EQ(m.zgyro, 2.0F);
  EXPECT_EQ(m.xmag, 0.25F);
  EXPECT_EQ(m.ymag, 0.0625F);
  EXPECT_EQ(m.zmag, 0.375F);
  EXPECT_FLOAT_EQ(m.abs_pressure, 954.6F);    // hPa
  EXPECT_FLOAT_EQ(m.diff_pressure, 2.45F);    // hPa
  EXPECT_FLOAT_EQ(m.pressure_alt, 500.0F);    // m
  EXPECT_NEAR(m.temperature, 11.75F, 1e-5F);  // degC; a float's last digit
  EXPECT_EQ(m.fields_updated, 0x1FFFU);
}

TEST(HilSensorMessages, SayWholeSensorsOnly) {
  HilSensors sensors;
  EXPECT_EQ(message_of(sensors).fields_updated, 0U);
  sensors.imu.emplace();
  EXPECT_EQ(message_of(sensors).fields_updated, 0x03FU);
  sensors.imu.reset();
  sensors.field_B_gauss = Vec3::Zero();
  EXPECT_EQ(message_of(sensors).fields_updated, 0x1C0U);
  sensors.field_B_gauss.reset();
  sensors.barometer.emplace();
  EXPECT_EQ(message_of(sensors).fields_updated, 0x1A00U);
  sensors.barometer.reset();
  sensors.pitot_pressure = 0;
  EXPECT_EQ(message_of(sensors).fields_updated, 0x400U);
}

HilFix fix_with(const Vec3& v_N) {
  HilFix fix;
  fix.v_N = v_N;
  return fix;
}

TEST(HilGpsMessages, HaveTheUnitsOfTheirFields) {
  HilFix fix = fix_with({3, -4, 1.25});
  fix.utc_us = 1'600'000'000'123'456;
  fix.unit = 1;
  fix.latitude_deg = 48.85884451;
  fix.longitude_deg = -120.123456789;
  fix.alt_msl = 488.1234;
  fix.position_sd = 1.5;
  fix.altitude_sd = 2.25;
  fix.satellites = 11;
  const mavlink::HilGps m = message_of(fix);
  EXPECT_EQ(m.time_usec, 1'600'000'000'123'456U);
  EXPECT_EQ(m.id, 1);
  EXPECT_EQ(m.fix_type, 3);
  EXPECT_EQ(m.lat, 488'588'445);
  EXPECT_EQ(m.lon, -1'201'234'568);
  EXPECT_EQ(m.alt, 488'123);
  EXPECT_EQ(m.eph, 150);
  EXPECT_EQ(m.epv, 225);
  EXPECT_EQ(m.vel, 500);  // over ground
  EXPECT_EQ(m.vn, 300);
  EXPECT_EQ(m.ve, -400);
  EXPECT_EQ(m.vd, 125);
  EXPECT_EQ(m.cog, 30'687);  // 306.87 degrees
  EXPECT_EQ(m.satellites_visible, 11);
  EXPECT_EQ(m.yaw, 0);  // not available
  fix.type = HilFixType::kNone;
  EXPECT_EQ(message_of(fix).fix_type, 0);
}

TEST(HilGpsMessages, HaveCoursesBelowAWholeTurn) {
  EXPECT_EQ(message_of(fix_with({1, 0, 0})).cog, 0);
  EXPECT_EQ(message_of(fix_with({0, 1, 0})).cog, 9000);
  EXPECT_EQ(message_of(fix_with({-1, 0, 0})).cog, 18'000);
  EXPECT_EQ(message_of(fix_with({1, -1e-9, 0})).cog, 0);
  EXPECT_EQ(message_of(fix_with({0.05, 0.05, 9})).cog, 65'535);  // unknown
  EXPECT_EQ(message_of(fix_with({kNan, 0, 0})).cog, 65'535);
}

TEST(HilGpsMessages, SayTheNearestThatTheyCan) {
  HilFix fix = fix_with({1e6, -1e6, kNan});
  fix.position_sd = 1e9;
  fix.altitude_sd = -1;
  fix.alt_msl = -1e9;
  fix.latitude_deg = 1e300;
  fix.utc_us = -1;
  const mavlink::HilGps m = message_of(fix);
  EXPECT_EQ(m.vn, 32'767);
  EXPECT_EQ(m.ve, -32'768);
  EXPECT_EQ(m.vd, 0);
  EXPECT_EQ(m.vel, 65'535);
  EXPECT_EQ(m.eph, 65'535);
  EXPECT_EQ(m.epv, 0);
  EXPECT_EQ(m.alt, std::numeric_limits<std::int32_t>::min());
  EXPECT_EQ(m.lat, std::numeric_limits<std::int32_t>::max());
  EXPECT_EQ(m.time_usec, 0U);
}

TEST(HilStateMessages, HaveTheUnitsOfTheirFields) {
  HilTruth truth;
  truth.time = Time::from_seconds(2.5);
  truth.latitude_deg = -33.5;
  truth.longitude_deg = 151.25;
  truth.alt_msl = 100.5;
  truth.v_N = {1, -2, 3.456};
  truth.q_NB = Quat(0.5, -0.5, 0.5, -0.5);
  truth.w_NB_B = {0.25, 0.5, -0.75};
  truth.a_B = {9.80665, -0.980665, 0};
  truth.indicated_airspeed = 17.25;
  truth.true_airspeed = 18;
  const mavlink::HilStateQuaternion m = message_of(truth);
  EXPECT_EQ(m.time_usec, 2'500'000U);
  EXPECT_EQ(m.attitude_quaternion, (std::array<float, 4>{0.5F, -0.5F, 0.5F, -0.5F}));
  EXPECT_EQ(m.rollspeed, 0.25F);
  EXPECT_EQ(m.pitchspeed, 0.5F);
  EXPECT_EQ(m.yawspeed, -0.75F);
  EXPECT_EQ(m.lat, -335'000'000);
  EXPECT_EQ(m.lon, 1'512'500'000);
  EXPECT_EQ(m.alt, 100'500);
  EXPECT_EQ(m.vx, 100);
  EXPECT_EQ(m.vy, -200);
  EXPECT_EQ(m.vz, 346);
  EXPECT_EQ(m.ind_airspeed, 1725);
  EXPECT_EQ(m.true_airspeed, 1800);
  EXPECT_EQ(m.xacc, 1000);  // thousandths of gravity
  EXPECT_EQ(m.yacc, -100);
  EXPECT_EQ(m.zacc, 0);
}

TEST(HilControlMessages, AreReadAndMadeSafe) {
  mavlink::HilActuatorControls m;
  m.time_usec = 123'456;
  m.controls = {0.5F,
                -1,
                1,
                7,
                -7,
                std::numeric_limits<float>::quiet_NaN(),
                -std::numeric_limits<float>::infinity()};
  m.controls[15] = 0.25F;
  m.mode = 0x81;
  m.flags = 1;
  const HilControls controls = controls_of(m);
  EXPECT_EQ(controls.time, Time::from_seconds(0.123456));
  EXPECT_EQ(controls.channel, (std::array<double, 16>{0.5, -1, 1, 1, -1, 0, -1, 0, 0, 0,
                                                      0, 0, 0, 0, 0, 0.25}));
  EXPECT_TRUE(controls.armed);
  EXPECT_TRUE(controls.lock_step);
  m = {};
  m.mode = 0x01;
  m.flags = 2;
  m.time_usec = std::numeric_limits<std::uint64_t>::max();
  EXPECT_FALSE(controls_of(m).armed);
  EXPECT_FALSE(controls_of(m).lock_step);
  EXPECT_GT(controls_of(m).time, Time());
}

}  // namespace
}  // namespace skein::physics::hil_test
