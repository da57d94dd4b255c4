// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "skein/link/vehicle_services/test/station.h"

namespace skein::vehicle_services::commands_test {
namespace {

using mavlink::CommandId;
using mavlink::CommandResult;
using mavlink::CoordinateFrame;
using enum mavlink::CommandResult;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

TEST(Commands, UnknownOnesAreAnsweredToo) {
  Station s;
  s.show(standing());
  EXPECT_EQ(s.result(static_cast<CommandId>(31'010)), number(kUnsupported));
  EXPECT_TRUE(s.server.take_requests().empty());
}

TEST(Commands, AreRefusedBeforeTheRunBegins) {
  Station s;
  EXPECT_EQ(s.result(CommandId::kArm, {1}), number(kFailed));
  EXPECT_EQ(s.result(CommandId::kReturn), number(kTemporarilyRejected));
  EXPECT_EQ(s.result(CommandId::kTakeOff, {0, 0, 0, 0, 0, 0, 50}),
            number(kTemporarilyRejected));
  EXPECT_EQ(s.result(CommandId::kLand), number(kTemporarilyRejected));
  EXPECT_EQ(s.result(CommandId::kGetHome), number(kTemporarilyRejected));
  EXPECT_TRUE(s.server.take_requests().empty());
}

TEST(Commands, OfOthersAreNoneOfItsBusiness) {
  Station s;
  s.show(standing());
  s.clear();
  mavlink::CommandLong m;
  m.command = static_cast<std::uint16_t>(CommandId::kArm);
  m.param1 = 1;
  m.target_system = 8;
  s.send(m);
  m.target_system = 7;
  m.target_component = 100;
  s.send(m);
  m.target_component = 1;
  s.send(m, 2);  // over a link that is not open
  EXPECT_TRUE(s.frames.empty());
  EXPECT_TRUE(s.server.take_requests().empty());
}

TEST(Commands, ForAllAreAnsweredWhereTheyOnlyAsk) {
  Station s;
  s.show(standing());
  s.clear();
  mavlink::CommandLong m;
  m.command = static_cast<std::uint16_t>(CommandId::kArm);
  m.param1 = 1;
  s.send(m);
  EXPECT_TRUE(s.heard<mavlink::CommandAck>().empty());
  EXPECT_TRUE(s.server.take_requests().empty());
  m.command = static_cast<std::uint16_t>(CommandId::kGetHome);
  s.send(m);
  EXPECT_EQ(s.last<mavlink::CommandAck>().result, 0);
  EXPECT_EQ(s.heard<mavlink::HomePosition>().size(), 1U);
}

TEST(Commands, TheAnswerComesBeforeWhatWasAskedFor) {
  Station s;
  s.show(standing());
  for (const float id : {33.F, 148.F, 242.F, 0.F, 300.F}) {
    EXPECT_EQ(s.result(CommandId::kRequestMessage, {id}), 0) << id;
    ASSERT_EQ(s.frames.size(), 2U) << id;
    mavlink::FrameParser().read(s.frames[1].bytes, [&](const mavlink::Frame& frame) {
      EXPECT_EQ(frame.id(), static_cast<std::uint32_t>(id));
    });
  }
  for (const float id : {397.F, 395.F, 9999.F, -1.F, kNan, 1e9F})
    EXPECT_EQ(s.result(CommandId::kRequestMessage, {id}), number(kUnsupported)) << id;
  EXPECT_EQ(s.result(CommandId::kRequestProtocolVersion), 0);
  EXPECT_EQ(s.last<mavlink::ProtocolVersion>().max_version, 200);
}

TEST(Arming, IsAskedOfTheSimulationOnce) {
  Station s;
  s.show(standing());
  EXPECT_EQ(s.result(CommandId::kArm, {1}), 0);
  EXPECT_TRUE(s.only_request<ArmRequest>().arm);
  // It counts as armed before the simulation has done so.
  EXPECT_EQ(s.result(CommandId::kArm, {1}), 0);
  EXPECT_TRUE(s.server.take_requests().empty());
  EXPECT_EQ(s.result(CommandId::kArm, {0}), 0);
  EXPECT_FALSE(s.only_request<ArmRequest>().arm);
  EXPECT_EQ(s.result(CommandId::kArm, {2}), number(kDenied));
}

TEST(Arming, IsRefusedWithAReasonUnlessForced) {
  for (const Make make : {Make::kArduPilot, Make::kPx4}) {
    Station s(make);
    VehicleSnapshot snapshot = standing();
    snapshot.not_ready = "no position";
    s.show(snapshot);
    EXPECT_EQ(s.result(CommandId::kArm, {1}),
              number(make == Make::kPx4 ? kTemporarilyRejected : kFailed));
    EXPECT_EQ(s.texts(), (std::vector<std::string>{"Arm: no position"}));
    EXPECT_TRUE(s.server.take_requests().empty());
    EXPECT_EQ(s.result(CommandId::kArm, {1, 21'196}), 0);
    EXPECT_TRUE(s.only_request<ArmRequest>().force);
  }
}

TEST(Arming, IsNotEndedInFlightUnlessForced) {
  Station s;
  s.show(flying());
  EXPECT_EQ(s.result(CommandId::kArm, {0}), number(kFailed));
  EXPECT_EQ(s.texts(), (std::vector<std::string>{"Disarm: it is in flight"}));
  EXPECT_EQ(s.result(CommandId::kArm, {0, 21'196}), 0);
  EXPECT_TRUE(s.only_request<ArmRequest>().force);
}

TEST(Arming, WhatTheSimulationDoesNotDoIsForgotten) {
  Station s;
  s.show(standing());
  EXPECT_EQ(s.result(CommandId::kArm, {1}), 0);
  s.run(4);  // and it stays disarmed
  s.server.take_requests();
  EXPECT_EQ(s.result(CommandId::kTakeOff, {0, 0, 0, 0, 0, 0, 50}),
            number(kTemporarilyRejected));
  EXPECT_EQ(s.texts().back(), "Take-off: it is not armed");
}

TEST(Commands, RepeatedOnesAreAnsweredAndNotExecutedAgain) {
  Station s;
  s.show(flying());
  EXPECT_EQ(s.command(CommandId::kChangeSpeed, {0, 21}).result, 0);
  for (std::uint8_t k = 1; k < 10; ++k) {
    s.run(3);
    EXPECT_EQ(s.command(CommandId::kChangeSpeed, {0, 21}, k).result, 0);
  }
  EXPECT_EQ(s.server.take_requests().size(), 1U);
  // Another one is another one, and the same after a long time too.
  EXPECT_EQ(s.command(CommandId::kChangeSpeed, {0, 22}, 1).result, 0);
  EXPECT_EQ(s.command(CommandId::kChangeSpeed, {0, 22}).result, 0);
  EXPECT_EQ(s.server.take_requests().size(), 2U);
  s.run(31);
  EXPECT_EQ(s.command(CommandId::kChangeSpeed, {0, 22}, 1).result, 0);
  EXPECT_EQ(s.server.take_requests().size(), 1U);
}

TEST(Commands, RepeatedRefusalsStayRefused) {
  Station s;
  VehicleSnapshot snapshot = standing();
  snapshot.not_ready = "no position";
  s.show(snapshot);
  EXPECT_EQ(s.command(CommandId::kArm, {1}).result, number(kFailed));
  s.show(standing());
  EXPECT_EQ(s.command(CommandId::kArm, {1}, 1).result, number(kFailed));
  EXPECT_EQ(s.command(CommandId::kArm, {1}).result, 0);
}

TEST(Commands, AFrameThatComesTwiceIsExecutedOnce) {
  Station s;
  s.show(flying());
  s.clear();
  mavlink::CommandLong m;
  m.target_system = 7;
  m.command = static_cast<std::uint16_t>(CommandId::kChangeSpeed);
  m.param2 = 21;
  s.send_twice(m);
  EXPECT_EQ(s.heard<mavlink::CommandAck>().size(), 2U);
  EXPECT_EQ(s.server.take_requests().size(), 1U);
}

TEST(Commands, InIntegersCannotSayThatTheyAreRepeated) {
  Station s;
  s.show(flying());
  const auto go = [&](double longitude) {
    return s
        .command_int(CommandId::kReposition, {-1, 1}, CoordinateFrame::kGlobalRelative,
                     47.001, longitude, 80)
        .result;
  };
  EXPECT_EQ(go(8.001), 0);
  EXPECT_EQ(go(8.001), 0);
  EXPECT_EQ(s.server.take_requests().size(), 1U);
  EXPECT_EQ(go(8.002), 0);
  EXPECT_EQ(go(8.001), 0);
  EXPECT_EQ(s.server.take_requests().size(), 2U) << "back again";
}

TEST(Commands, WaitWhileTheSimulationDoesNotTakeThem) {
  Station s;
  s.show(flying());
  int accepted = 0;
  for (int k = 0; k < 1000; ++k)
    accepted += s.result(CommandId::kChangeSpeed, {0, 18 + 0.001F * float(k)}) == 0;
  EXPECT_EQ(accepted, 64);
  EXPECT_EQ(s.result(CommandId::kChangeSpeed, {0, 20}), number(kTemporarilyRejected));
  EXPECT_EQ(s.server.take_requests().size(), 64U);
  EXPECT_EQ(s.result(CommandId::kChangeSpeed, {0, 20.5}), 0);
}

TEST(Modes, AreSetByTheirNumbers) {
  struct Case {
    Make make;
    bool hovers;
    std::vector<float> p;
    VehicleMode mode;
  };
  for (const auto& [make, hovers, p, mode] :
       {Case{Make::kArduPilot, false, {1, 11}, VehicleMode::kReturn},
        {Make::kArduPilot, false, {81, 5}, VehicleMode::kStabilized},
        {Make::kArduPilot, true, {1, 17}, VehicleMode::kHold},
        {Make::kArduPilot, true, {1, 9}, VehicleMode::kLand},
        {Make::kPx4, true, {1, 4, 5}, VehicleMode::kReturn},
        {Make::kPx4, false, {29, 4, 3}, VehicleMode::kHold},
        {Make::kPx4, true, {1, 7, 0}, VehicleMode::kStabilized}}) {
    Station s(make, hovers);
    s.show(flying());
    EXPECT_EQ(s.result(CommandId::kSetMode, p), 0) << p[1];
    EXPECT_EQ(s.only_request<ModeRequest>().mode, mode) << p[1];
    EXPECT_EQ(s.result(CommandId::kSetMode, {0, p[1]}), number(kDenied));
    EXPECT_EQ(s.result(CommandId::kSetMode, {1, 77, 9}), number(kDenied));
    EXPECT_EQ(s.texts().size(), 1U);
  }
}

TEST(Modes, AreShownByTheNumberThatWasAskedFor) {
  Station s(Make::kArduPilot, true);
  VehicleSnapshot snapshot = flying();
  s.show(snapshot);
  EXPECT_EQ(s.result(CommandId::kSetMode, {1, 17}), 0);
  snapshot.condition.mode = VehicleMode::kHold;
  s.show(snapshot);
  EXPECT_EQ(s.last<mavlink::Heartbeat>().custom_mode, 17U) << "BRAKE, not LOITER";
  snapshot.condition.mode = VehicleMode::kReturn;
  s.show(snapshot);
  EXPECT_EQ(s.last<mavlink::Heartbeat>().custom_mode, 6U);
  snapshot.condition.mode = VehicleMode::kHold;
  s.show(snapshot);
  EXPECT_EQ(s.last<mavlink::Heartbeat>().custom_mode, 5U) << "nobody asked this time";
}

TEST(Modes, AreSetByTheOldMessageToo) {
  for (const Make make : {Make::kArduPilot, Make::kPx4}) {
    Station s(make, false);
    s.show(flying());
    s.clear();
    mavlink::SetMode m;
    m.target_system = 7;
    m.base_mode = 1;
    m.custom_mode = make == Make::kPx4 ? 0x05040000 : 11;
    s.send(m);
    EXPECT_EQ(s.only_request<ModeRequest>().mode, VehicleMode::kReturn);
    const auto acks = s.heard<mavlink::CommandAck>();
    ASSERT_EQ(acks.size(), make == Make::kPx4 ? 0U : 1U);
    if (!acks.empty()) {
      EXPECT_EQ(acks[0].command, 11);
    }
    m.base_mode = 0;
    s.send(m);
    EXPECT_TRUE(s.server.take_requests().empty());
  }
}

TEST(Modes, ThatCannotBeFlownAreRefusedWithAReason) {
  Station s;
  VehicleSnapshot snapshot = flying();
  s.show(snapshot);
  EXPECT_EQ(s.result(CommandId::kSetMode, {1, 10}), number(kTemporarilyRejected));
  EXPECT_EQ(s.texts(), (std::vector<std::string>{"Mode AUTO: no mission is stored"}));
  snapshot.condition.position = false;
  s.show(snapshot);
  EXPECT_EQ(s.result(CommandId::kReturn), number(kTemporarilyRejected));
  EXPECT_EQ(s.texts(), (std::vector<std::string>{"Mode RTL: its position is not known"}));
  EXPECT_EQ(s.result(CommandId::kSetMode, {1, 5}), 0) << "sticks need none";
}

TEST(Modes, OffboardNeedsAStreamOfSetpoints) {
  Station s(Make::kPx4, true);
  s.show(flying());
  EXPECT_EQ(s.result(CommandId::kSetMode, {1, 6}), number(kTemporarilyRejected));
  mavlink::SetPositionTargetLocalNed setpoint;
  setpoint.target_system = 7;
  setpoint.coordinate_frame = 1;
  s.send(setpoint);
  s.server.take_requests();
  EXPECT_EQ(s.result(CommandId::kSetMode, {1, 6}), 0);
  s.run(1.5);
  EXPECT_EQ(s.result(CommandId::kSetMode, {1, 6}), number(kTemporarilyRejected));
}

TEST(Modes, TheSimplestCommandsOfAll) {
  Station s;
  s.show(flying());
  EXPECT_EQ(s.result(CommandId::kReturn), 0);
  EXPECT_EQ(s.only_request<ModeRequest>().mode, VehicleMode::kReturn);
  EXPECT_EQ(s.result(CommandId::kLoiter), 0);
  EXPECT_EQ(s.only_request<ModeRequest>().mode, VehicleMode::kHold);
  EXPECT_EQ(s.result(CommandId::kLoiterTime, {30}), 0);
  EXPECT_EQ(s.only_request<ModeRequest>().mode, VehicleMode::kHold);
  EXPECT_EQ(s.result(CommandId::kReboot, {1}), number(kDenied));
  s.show(standing());
  EXPECT_EQ(s.result(CommandId::kReboot, {1}), number(kUnsupported));
}

TEST(Landing, IsWhereItIsOrAtAPlace) {
  Station s;
  VehicleSnapshot snapshot = flying();
  snapshot.ground_msl = 395;
  s.show(snapshot);
  EXPECT_EQ(s.result(CommandId::kLand), 0);
  const auto here = s.only_request<LandRequest>();
  EXPECT_FALSE(here.point);
  EXPECT_EQ(here.ground_msl, 395);
  EXPECT_FALSE(here.course);
  EXPECT_EQ(s.result(CommandId::kLand, {0, 0, 0, 0, 47, 8, 0}), number(kIntOnly));
  EXPECT_EQ(s.command_int(CommandId::kLand, {0, 0, 0, 90}, CoordinateFrame::kGlobal,
                          47.01, 8.02, 410)
                .result,
            0);
  const auto there = s.only_request<LandRequest>();
  ASSERT_TRUE(there.point);
  EXPECT_NEAR((*there.point - test_frame().to_plane(47.01, 8.02)).norm(), 0, 0.02);
  EXPECT_EQ(there.ground_msl, 410);
  EXPECT_NEAR(*there.course, geo::radians(90), 1e-6);
}

TEST(TakeOff, ReportsHowFarItHasCome) {
  for (const Make make : {Make::kArduPilot, Make::kPx4}) {
    Station s(make, true);
    VehicleSnapshot snapshot = standing();
    snapshot.condition.armed = true;
    s.show(snapshot);
    const float altitude = make == Make::kPx4 ? 450.F : 50.F;  // above the sea, home
    EXPECT_EQ(s.result(CommandId::kTakeOff, {0, 0, 0, kNan, kNan, kNan, altitude}),
              number(kInProgress));
    EXPECT_EQ(s.only_request<TakeOffRequest>().altitude_msl, 450);
    // Asked again because the answer was lost; and by another.
    EXPECT_EQ(
        s.command(CommandId::kTakeOff, {0, 0, 0, kNan, kNan, kNan, altitude}, 1).result,
        number(kInProgress));
    EXPECT_EQ(s.result(CommandId::kTakeOff, {0, 0, 0, kNan, kNan, kNan, altitude + 10}),
              number(kTemporarilyRejected));
    snapshot.condition.mode = VehicleMode::kTakeOff;
    snapshot.condition.on_ground = false;
    s.clear();
    for (int k = 0; k < 40; ++k) {
      snapshot.motion.p_N.z() = -400 - k;
      s.show(snapshot);
      s.run(0.1);
    }
    const auto acks = s.heard<mavlink::CommandAck>();
    ASSERT_GE(acks.size(), 3U);
    ASSERT_LE(acks.size(), 5U) << "once a second";
    for (std::size_t k = 1; k < acks.size(); ++k) {
      EXPECT_EQ(acks[k].result, number(kInProgress));
      EXPECT_GT(acks[k].progress, acks[k - 1].progress);
    }
    snapshot.motion.p_N.z() = -448;
    s.clear();
    s.show(snapshot);
    ASSERT_EQ(s.heard<mavlink::CommandAck>().size(), 1U);
    EXPECT_EQ(s.last<mavlink::CommandAck>().result, 0);
    EXPECT_EQ(
        s.command(CommandId::kTakeOff, {0, 0, 0, kNan, kNan, kNan, altitude}, 2).result,
        0)
        << "the last answer was lost";
    EXPECT_TRUE(s.server.take_requests().empty());
  }
}

// How a take-off ends that has begun.
int end_of_take_off(const std::function<void(Station&, VehicleSnapshot&)>& happens) {
  Station s(Make::kArduPilot, true);
  VehicleSnapshot snapshot = standing();
  snapshot.condition.armed = true;
  s.show(snapshot);
  EXPECT_EQ(s.result(CommandId::kTakeOff, {0, 0, 0, 0, 0, 0, 50}), number(kInProgress));
  snapshot.condition.mode = VehicleMode::kTakeOff;
  snapshot.condition.on_ground = false;
  snapshot.motion.p_N.z() = -410;
  s.show(snapshot);
  s.clear();
  happens(s, snapshot);
  s.show(snapshot);
  int last = -1;
  for (const auto& ack : s.heard<mavlink::CommandAck>())
    if (ack.command == 22) last = ack.result;
  return last;
}

TEST(TakeOff, EndsForOtherReasonsToo) {
  EXPECT_EQ(end_of_take_off([](Station& s, VehicleSnapshot&) {
              EXPECT_EQ(s.result(CommandId::kReturn), 0);
              s.step();
            }),
            number(kCancelled));
  EXPECT_EQ(end_of_take_off([](Station&, VehicleSnapshot& v) {
              v.condition.armed = false;
              v.condition.on_ground = true;
            }),
            number(kFailed));
  EXPECT_EQ(end_of_take_off([](Station&, VehicleSnapshot& v) {
              v.condition.mode = VehicleMode::kLand;
            }),
            number(kFailed));
  // The vehicle has ended it below the altitude, and climbs on or does not.
  for (const auto& [altitude, result] :
       {std::pair{449.5, kAccepted}, {442., kAccepted}, {430., kFailed}})
    EXPECT_EQ(end_of_take_off([altitude = altitude](Station& s, VehicleSnapshot& v) {
                v.motion.p_N.z() = -432;
                v.condition.mode = VehicleMode::kHold;
                s.show(v);
                s.run(5);
                v.motion.p_N.z() = -altitude;
                s.show(v);
                s.run(6);
              }),
              number(result))
        << altitude;
  EXPECT_EQ(end_of_take_off([](Station& s, VehicleSnapshot&) {
              s.now.simulated += Time::from_seconds(181);
            }),
            number(kFailed));
}

TEST(TakeOff, NeedsAnAltitudeAboveItAndTheGround) {
  Station s(Make::kArduPilot, true);
  VehicleSnapshot snapshot = standing();
  snapshot.condition.armed = true;
  s.show(snapshot);
  EXPECT_EQ(s.result(CommandId::kTakeOff, {}), number(kDenied));
  EXPECT_EQ(
      s.command_int(CommandId::kTakeOff, {}, CoordinateFrame::kGlobalTerrain, 0, 0, 50)
          .result,
      number(kUnsupportedFrame));
  s.show(flying());
  EXPECT_EQ(s.result(CommandId::kTakeOff, {0, 0, 0, 0, 0, 0, 500}),
            number(kTemporarilyRejected));
}

TEST(TakeOff, BeforeArmingBeginsWithItWherePx4DoesSo) {
  Station s(Make::kPx4, true);
  VehicleSnapshot snapshot = standing();
  s.show(snapshot);
  EXPECT_EQ(s.result(CommandId::kTakeOff, {-1, 0, 0, kNan, kNan, kNan, 430}), 0);
  EXPECT_EQ(s.only_request<ModeRequest>().mode, VehicleMode::kTakeOff);
  snapshot.condition.mode = VehicleMode::kTakeOff;
  s.show(snapshot);
  EXPECT_EQ(s.result(CommandId::kArm, {1}), 0);
  EXPECT_TRUE(s.only_request<ArmRequest>().arm);
  snapshot.condition.armed = true;
  s.show(snapshot);
  EXPECT_EQ(s.only_request<TakeOffRequest>().altitude_msl, 430);
  Station ardupilot(Make::kArduPilot, true);
  ardupilot.show(standing());
  EXPECT_EQ(ardupilot.result(CommandId::kTakeOff, {0, 0, 0, 0, 0, 0, 30}),
            number(kTemporarilyRejected));
}

TEST(TakeOff, AsAModeGoesToTheHeightOfTheParameter) {
  Station s(Make::kArduPilot, false);
  VehicleSnapshot snapshot = standing();
  s.show(snapshot);
  EXPECT_EQ(s.result(CommandId::kSetMode, {1, 13}), 0);
  EXPECT_EQ(s.only_request<ModeRequest>().mode, VehicleMode::kTakeOff);
  snapshot.condition.mode = VehicleMode::kTakeOff;
  s.show(snapshot);
  EXPECT_EQ(s.last<mavlink::Heartbeat>().custom_mode, 13U);
  s.run(100);  // the pilot takes his time
  snapshot.condition.armed = true;
  s.show(snapshot);
  EXPECT_EQ(s.only_request<TakeOffRequest>().altitude_msl, 450);
}

TEST(Speed, StaysWithinWhatTheVehicleFlies) {
  Station s;
  s.show(flying());
  EXPECT_EQ(s.result(CommandId::kChangeSpeed, {0, 22, -1}), 0);
  EXPECT_EQ(s.only_request<SpeedRequest>().airspeed, 22);
  EXPECT_EQ(s.result(CommandId::kChangeSpeed, {0, 14}), number(kDenied));
  EXPECT_EQ(s.texts()[0], "Speed: 14.0 m/s is outside 15.0 to 25.0 m/s");
  EXPECT_EQ(s.result(CommandId::kChangeSpeed, {0, kNan}), number(kDenied));
  EXPECT_EQ(s.result(CommandId::kChangeSpeed, {1, 20}), number(kDenied));
  EXPECT_EQ(s.result(CommandId::kChangeSpeed, {0, -1, 50}), 0) << "no change";
  EXPECT_TRUE(s.server.take_requests().empty());
  Station hovers(Make::kArduPilot, true);
  hovers.show(flying());
  EXPECT_EQ(hovers.result(CommandId::kChangeSpeed, {1, 5}), 0);
}

TEST(Home, IsGivenOutAndSet) {
  VehicleServerOptions options = test_options(Make::kArduPilot, false);
  options.home_can_be_set = true;
  Station s(options);
  s.show(flying());
  EXPECT_EQ(s.result(CommandId::kGetHome), 0);
  EXPECT_EQ(s.last<mavlink::HomePosition>().altitude, 400'000);
  EXPECT_FALSE(s.server.take_home());
  EXPECT_EQ(s.result(CommandId::kSetHome, {1}), 0);
  EXPECT_EQ(s.server.take_home(), Vec3(300, 250, -400)) << "on the ground below";
  EXPECT_FALSE(s.server.take_home());
  EXPECT_EQ(
      s.command_int(CommandId::kSetHome, {0}, CoordinateFrame::kGlobal, 47.01, 8.02, 420)
          .result,
      0);
  const auto home = s.server.take_home();
  ASSERT_TRUE(home);
  EXPECT_NEAR((geo::horizontal(*home) - test_frame().to_plane(47.01, 8.02)).norm(), 0,
              0.02);
  EXPECT_EQ(home->z(), -420);
  EXPECT_EQ(s.result(CommandId::kSetHome, {0}), number(kDenied));
  EXPECT_EQ(s.command_int(CommandId::kSetHome, {0}, CoordinateFrame::kGlobal, -47, 8, 420)
                .result,
            number(kDenied));
  Station fixed;
  fixed.show(flying());
  EXPECT_EQ(fixed.result(CommandId::kSetHome, {1}), number(kDenied))
      << "where nobody takes it";
  EXPECT_FALSE(fixed.server.take_home());
}

}  // namespace
}  // namespace skein::vehicle_services::commands_test
