// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "skein/link/vehicle_services/test/station.h"

namespace skein::vehicle_services::pilot_test {
namespace {

using mavlink::CommandId;

mavlink::RcChannelsOverride sticks(std::uint16_t roll, std::uint16_t pitch,
                                   std::uint16_t throttle, std::uint16_t yaw) {
  mavlink::RcChannelsOverride m;
  m.target_system = 7;
  m.target_component = 1;
  m.chan1_raw = roll;
  m.chan2_raw = pitch;
  m.chan3_raw = throttle;
  m.chan4_raw = yaw;
  m.chan5_raw = m.chan6_raw = m.chan7_raw = m.chan8_raw = 65'535;
  return m;
}

VehicleSnapshot in_mode(VehicleMode mode) {
  VehicleSnapshot snapshot = flying();
  snapshot.condition.mode = mode;
  return snapshot;
}

TEST(PilotOverride, SticksCountInTheModesThatAreFlownByThem) {
  for (const auto& [mode, flight_mode] :
       {std::pair{VehicleMode::kManual, FlightMode::kManual},
        {VehicleMode::kStabilized, FlightMode::kStabilized}}) {
    Station s;
    s.show(in_mode(mode));
    s.send(sticks(1750, 1250, 1600, 1500));
    const PilotInput input = s.only_request<PilotRequest>().input;
    EXPECT_TRUE(input.takes_over);
    EXPECT_EQ(input.mode, flight_mode);
    EXPECT_DOUBLE_EQ(input.roll, 0.5);
    EXPECT_DOUBLE_EQ(input.pitch, -0.5);
    EXPECT_DOUBLE_EQ(input.throttle, 0.6);
    EXPECT_DOUBLE_EQ(input.yaw, 0);
    s.run(1.5);
    EXPECT_EQ(s.last<mavlink::RcChannels>().chan1_raw, 1750);
    EXPECT_EQ(s.last<mavlink::RcChannels>().chancount, 4);
  }
}

TEST(PilotOverride, InOtherModesAStickMustBeMoved) {
  Station s;
  s.show(in_mode(VehicleMode::kMission));
  s.send(sticks(1500, 1500, 1000, 1500));
  s.send(sticks(1600, 1500, 2000, 1450));  // a little, and the throttle
  EXPECT_TRUE(s.server.take_requests().empty());
  s.send(sticks(1500, 1320, 1500, 1500));
  const PilotInput input = s.only_request<PilotRequest>().input;
  EXPECT_TRUE(input.takes_over);
  EXPECT_EQ(input.mode, FlightMode::kStabilized);
  // From now on the pilot flies, also with the sticks in the middle.
  s.send(sticks(1500, 1500, 1500, 1500));
  EXPECT_TRUE(s.only_request<PilotRequest>().input.takes_over);
}

TEST(PilotOverride, IsEndedByReleasingTheChannels) {
  for (const std::uint16_t released : std::initializer_list<std::uint16_t>{0, 65'535}) {
    Station s;
    s.show(in_mode(VehicleMode::kManual));
    s.send(sticks(1700, 1500, 1500, 1500));
    s.server.take_requests();
    s.send(sticks(released, released, released, released));
    EXPECT_FALSE(s.only_request<PilotRequest>().input.takes_over);
    s.send(sticks(released, released, released, released));
    EXPECT_TRUE(s.server.take_requests().empty()) << "once";
  }
}

TEST(PilotOverride, IsEndedBySilence) {
  Station s;
  s.show(in_mode(VehicleMode::kManual));
  s.send(sticks(1700, 1500, 1500, 1500));
  s.server.take_requests();
  s.run(2.9, false);
  EXPECT_TRUE(s.server.take_requests().empty());
  s.run(0.2, false);
  EXPECT_FALSE(s.only_request<PilotRequest>().input.takes_over);
}

TEST(PilotOverride, AChannelThatIsLeftOutKeepsItsValue) {
  Station s;
  s.show(in_mode(VehicleMode::kManual));
  s.send(sticks(1700, 1500, 1600, 1500));
  s.send(sticks(65'535, 1600, 0, 65'535));
  const PilotInput input = s.only_request<PilotRequest>().input;
  EXPECT_DOUBLE_EQ(input.roll, 0.4);
  EXPECT_DOUBLE_EQ(input.pitch, 0.2);
  EXPECT_DOUBLE_EQ(input.throttle, 0) << "released: as the vehicle has it";
}

TEST(PilotOverride, EndsWhenAnotherModeIsCommanded) {
  Station s;
  s.show(in_mode(VehicleMode::kHold));
  s.send(sticks(1500, 1500, 1500, 1500));
  s.send(sticks(1900, 1500, 1500, 1500));
  EXPECT_TRUE(s.only_request<PilotRequest>().input.takes_over);
  EXPECT_EQ(s.result(CommandId::kReturn), 0);
  auto requests = s.server.take_requests();
  ASSERT_EQ(requests.size(), 2U);
  EXPECT_FALSE(std::get<PilotRequest>(requests[0]).input.takes_over);
  EXPECT_EQ(std::get<ModeRequest>(requests[1]).mode, VehicleMode::kReturn);
  s.show(in_mode(VehicleMode::kReturn));
  s.send(sticks(1900, 1500, 1500, 1500));
  EXPECT_TRUE(s.server.take_requests().empty()) << "the stick is still to the side";
  s.send(sticks(1500, 1500, 1500, 1500));
  s.send(sticks(1900, 1500, 1500, 1500));
  EXPECT_TRUE(s.only_request<PilotRequest>().input.takes_over);
}

TEST(PilotOverride, EndsWhenTheVehicleLeavesTheModeByItself) {
  Station s;
  s.show(in_mode(VehicleMode::kManual));
  s.send(sticks(1900, 1500, 1500, 1500));
  s.server.take_requests();
  s.show(in_mode(VehicleMode::kReturn));  // its battery is low
  s.send(sticks(1900, 1500, 1500, 1500));
  EXPECT_FALSE(s.only_request<PilotRequest>().input.takes_over);
}

TEST(PilotOverride, AJoystickIsTheSame) {
  Station s;
  s.show(in_mode(VehicleMode::kStabilized));
  mavlink::ManualControl m;
  m.target = 8;
  s.send(m);
  EXPECT_TRUE(s.server.take_requests().empty()) << "of another";
  m.target = 7;
  m.x = 500;
  m.y = -1000;
  m.z = 750;
  m.r = 32'767;  // no such axis
  s.send(m);
  const PilotInput input = s.only_request<PilotRequest>().input;
  EXPECT_DOUBLE_EQ(input.pitch, -0.5) << "forward is down";
  EXPECT_DOUBLE_EQ(input.roll, -1);
  EXPECT_DOUBLE_EQ(input.throttle, 0.75);
  EXPECT_DOUBLE_EQ(input.yaw, 0);
}

}  // namespace
}  // namespace skein::vehicle_services::pilot_test
