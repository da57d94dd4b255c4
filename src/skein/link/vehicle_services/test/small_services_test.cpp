// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <set>
#include <string>
#include <tuple>

#include "skein/link/mavlink/payload.h"
#include "skein/link/vehicle_services/test/station.h"
#include "skein/link/vehicle_services/vehicle_numbers.h"

namespace skein::vehicle_services::small_services_test {
namespace {

TEST(Timesync, GivesTheClockOfTelemetry) {
  Station s;
  s.show(standing());
  s.run(2.5);
  s.clear();
  mavlink::Timesync m;
  m.ts1 = 123'456;
  s.send(m);
  const auto answer = s.last<mavlink::Timesync>();
  EXPECT_EQ(answer.tc1, 2'500'000'000);
  EXPECT_EQ(answer.ts1, 123'456);
  EXPECT_EQ(answer.target_system, 255);
  s.clear();
  m.tc1 = 5;  // somebody's answer
  s.send(m);
  EXPECT_TRUE(s.frames.empty());
}

TEST(Timesync, NeverAnswersWithAQuestion) {
  Station s;
  s.send(mavlink::Timesync());
  EXPECT_NE(s.last<mavlink::Timesync>().tc1, 0);
}

TEST(Ping, IsAnsweredToWhoAsked) {
  Station s;
  mavlink::Ping m;
  m.seq = 9;
  m.time_usec = 77;
  s.send(m);
  const auto answer = s.last<mavlink::Ping>();
  EXPECT_EQ(answer.seq, 9U);
  EXPECT_EQ(answer.time_usec, 77U);
  EXPECT_EQ(answer.target_system, 255);
  EXPECT_EQ(answer.target_component, 190);
  s.clear();
  m.target_system = 7;  // an answer
  m.target_component = 1;
  s.send(m);
  EXPECT_TRUE(s.frames.empty());
}

TEST(Files, AreDeniedAtOnce) {
  Station s;
  mavlink::FileTransferProtocol m;
  m.target_system = 7;
  m.payload[0] = 0xff;  // sequence 255
  m.payload[2] = 3;     // session
  m.payload[3] = 4;     // open for reading
  s.send(m);
  auto answer = s.last<mavlink::FileTransferProtocol>();
  EXPECT_EQ(answer.payload[0], 0);
  EXPECT_EQ(answer.payload[1], 1);
  EXPECT_EQ(answer.payload[2], 3);
  EXPECT_EQ(answer.payload[3], 129);
  EXPECT_EQ(answer.payload[4], 1);
  EXPECT_EQ(answer.payload[5], 4);
  EXPECT_NE(answer.payload[12], 0);
  EXPECT_EQ(answer.target_system, 255);
  m.payload[3] = 2;  // end all sessions
  s.send(m);
  EXPECT_EQ(s.last<mavlink::FileTransferProtocol>().payload[3], 128);
  s.clear();
  m.payload[3] = 128;  // somebody's answer
  s.send(m);
  EXPECT_TRUE(s.frames.empty());
}

TEST(Logs, ThereAreNone) {
  Station s;
  mavlink::LogRequestList list;
  list.target_system = 7;
  s.send(list);
  EXPECT_EQ(s.last<mavlink::LogEntry>().num_logs, 0);
  mavlink::LogRequestData data;
  data.target_system = 7;
  data.id = 4;
  s.send(data);
  EXPECT_EQ(s.last<mavlink::LogData>().count, 0);
  EXPECT_EQ(s.last<mavlink::LogData>().id, 4);
  s.clear();
  mavlink::LogErase erase;
  erase.target_system = 7;
  s.send(erase);
  EXPECT_TRUE(s.frames.empty());
}

TEST(VehicleParameters, AreKnownByTheNamesOfTheMake) {
  for (const auto& [make, hovers, name, value] : {
           std::tuple{Make::kArduPilot, false, "AIRSPEED_CRUISE", 20.0},
           {Make::kArduPilot, true, "WPNAV_SPEED", 800.0},
           {Make::kPx4, false, "FW_AIRSPD_TRIM", 20.0},
           {Make::kPx4, true, "MPC_XY_CRUISE", 8.0},
           {Make::kArduPilot, false, "SYSID_THISMAV", 7.0},
           {Make::kPx4, false, "MAV_SYS_ID", 7.0},
       }) {
    const Station s(make, hovers);
    const Parameter* parameter = s.server.parameter(name);
    ASSERT_NE(parameter, nullptr) << name;
    EXPECT_DOUBLE_EQ(parameter->value, value) << name;
  }
}

TEST(VehicleParameters, AreAllWithinTheirBoundsAndNamedOnce) {
  for (const Make make : {Make::kArduPilot, Make::kPx4})
    for (const bool hovers : {false, true}) {
      Station s(make, hovers);
      mavlink::ParamRequestList list;
      s.send(list);
      s.run(1);
      const auto all = s.heard<mavlink::ParamValue>();
      ASSERT_GE(all.size(), 9U);
      std::set<std::string> names;
      for (const auto& m : all) {
        EXPECT_EQ(m.param_count, all.size());
        const std::string name(mavlink::text_of(m.param_id));
        EXPECT_TRUE(names.insert(name).second) << name;
        const Parameter* parameter = s.server.parameter(name);
        ASSERT_NE(parameter, nullptr);
        EXPECT_GE(parameter->value, parameter->lowest) << name;
        EXPECT_LE(parameter->value, parameter->highest) << name;
      }
    }
}

mavlink::ParamSet change(const char* name, float value) {
  mavlink::ParamSet m;
  m.target_system = 7;
  m.target_component = 1;
  mavlink::set_text(m.param_id, name);
  m.param_value = value;
  m.param_type = 9;
  return m;
}

TEST(VehicleParameters, Act) {
  Station s(Make::kArduPilot, true);
  s.show(flying());
  s.send(change("WPNAV_SPEED", 550));
  EXPECT_DOUBLE_EQ(s.only_request<SpeedRequest>().airspeed, 5.5);
  Station plane;
  VehicleSnapshot unready = standing();
  unready.not_ready = "no position";
  plane.show(unready);
  plane.send(change("ARMING_CHECK", 0));
  EXPECT_EQ(plane.result(mavlink::CommandId::kArm, {1}), 0) << "unchecked";
  plane.server.take_requests();
  plane.show(flying());
  plane.send(change("WP_LOITER_RAD", -90));
  EXPECT_EQ(plane
                .command_int(mavlink::CommandId::kReposition, {-1},
                             mavlink::CoordinateFrame::kGlobal, 47, 8, 500)
                .result,
            0);
  const auto circle = plane.only_request<FlyToRequest>();
  EXPECT_EQ(circle.radius, 90);
  EXPECT_FALSE(circle.clockwise);
  plane.send(change("TKOFF_ALT", 80));
  plane.send(change("AIRSPEED_MAX", 80));
  EXPECT_EQ(plane.server.parameter("AIRSPEED_MAX")->value, 25) << "a fact";
  VehicleSnapshot armed = standing();
  armed.condition.armed = true;
  plane.show(armed);
  EXPECT_EQ(plane.result(mavlink::CommandId::kSetMode, {1, 13}), 0);
  EXPECT_EQ(plane.only_request<TakeOffRequest>().altitude_msl, 480);
}

TEST(VehicleParameters, OfTheOptionsComeLast) {
  VehicleServerOptions options = test_options(Make::kArduPilot, false);
  options.parameters = {{"WP_RADIUS", ParameterType::kReal32, 40, 40, 40, true}};
  const Station s(options);
  EXPECT_EQ(s.server.parameter("WP_RADIUS")->value, 40);
  EXPECT_EQ(s.server.parameter("NO_SUCH"), nullptr);
}

TEST(VehicleNumbers, AreDistinctForAllVehicles) {
  EXPECT_EQ(numbers_of_vehicle(0), (VehicleNumbers{0, 1}));
  EXPECT_EQ(numbers_of_vehicle(249), (VehicleNumbers{0, 250}));
  EXPECT_EQ(numbers_of_vehicle(250), (VehicleNumbers{1, 1}));
  std::set<std::pair<int, int>> all;
  for (std::size_t index = 0; index < 2000; ++index) {
    const VehicleNumbers numbers = numbers_of_vehicle(index);
    EXPECT_TRUE(all.emplace(numbers.port_offset, numbers.system).second);
    EXPECT_GE(numbers.system, 1);
    EXPECT_LE(numbers.system, 250);
  }
}

TEST(VehicleServer, AnswersOverTheLinkThatItWasAskedOn) {
  Station s;
  s.server.open(2, s.now);
  s.show(standing());
  s.clear();
  s.send(mavlink::Ping(), 2);
  EXPECT_TRUE(s.heard<mavlink::Ping>(1).empty());
  EXPECT_EQ(s.heard<mavlink::Ping>(2).size(), 1U);
  s.server.close(2);
  s.clear();
  s.send(mavlink::Ping(), 2);
  s.run(2);
  for (const auto& h : s.frames) EXPECT_EQ(h.channel, 1U);
}

TEST(VehicleServer, PassesOverItsOwnFrames) {
  Station s;
  s.show(standing());
  s.clear();
  s.writer = mavlink::FrameWriter(7, 1);
  s.send(mavlink::Ping());
  s.writer = mavlink::FrameWriter(0, 1);
  s.send(mavlink::Ping());
  EXPECT_TRUE(s.frames.empty());
}

}  // namespace
}  // namespace skein::vehicle_services::small_services_test
