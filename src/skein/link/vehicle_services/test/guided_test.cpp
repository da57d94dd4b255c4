// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "skein/link/vehicle_services/test/station.h"

namespace skein::vehicle_services::guided_test {
namespace {

using mavlink::CommandId;
using mavlink::CoordinateFrame;
using enum mavlink::CommandResult;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr double kLatitude = 47.005, kLongitude = 8.01;

Vec2 place() {
  return test_frame().to_plane(kLatitude, kLongitude);
}

int reposition(Station& s, std::vector<float> p, CoordinateFrame frame, float z) {
  return s
      .command_int(CommandId::kReposition, std::move(p), frame, kLatitude, kLongitude, z)
      .result;
}

mavlink::SetPositionTargetGlobalInt global_target(std::uint16_t mask) {
  mavlink::SetPositionTargetGlobalInt m;
  m.target_system = 7;
  m.target_component = 1;
  m.coordinate_frame = 6;
  m.type_mask = mask;
  m.lat_int = degrees_e7(kLatitude);
  m.lon_int = degrees_e7(kLongitude);
  m.alt = 120;
  return m;
}

mavlink::SetPositionTargetLocalNed local_target(CoordinateFrame frame,
                                                std::uint16_t mask) {
  mavlink::SetPositionTargetLocalNed m;
  m.target_system = 7;
  m.target_component = 1;
  m.coordinate_frame = static_cast<std::uint8_t>(frame);
  m.type_mask = mask;
  return m;
}

constexpr std::uint16_t kPlaceOnly = 0x0ff8, kVelocityOnly = 0x0fc7,
                        kAltitudeOnly = 0x0ffb, kPlaceAndVelocity = 0x0fc0,
                        kAll = 0x0800;  // but for the rate of yaw

TEST(Reposition, FliesToAPlace) {
  Station s;
  s.show(flying());
  EXPECT_EQ(reposition(s, {-1, 0, 150, 1}, CoordinateFrame::kGlobalRelative, 80), 0);
  const auto request = s.only_request<FlyToRequest>();
  EXPECT_NEAR((geo::horizontal(request.p_N) - place()).norm(), 0, 0.02);
  EXPECT_DOUBLE_EQ(request.p_N.z(), -480);
  EXPECT_EQ(request.radius, 150);
  EXPECT_FALSE(request.clockwise);
  EXPECT_FALSE(request.airspeed);
  EXPECT_EQ(reposition(s, {18, 1, 0, kNan}, CoordinateFrame::kGlobal, 550), 0);
  const auto other = s.only_request<FlyToRequest>();
  EXPECT_DOUBLE_EQ(other.p_N.z(), -550);
  EXPECT_EQ(other.airspeed, 18);
  EXPECT_EQ(other.radius, 60) << "that of the parameter";
  EXPECT_TRUE(other.clockwise);
  EXPECT_EQ(reposition(s, {50}, CoordinateFrame::kGlobal, 550), number(kDenied));
  EXPECT_EQ(reposition(s, {}, CoordinateFrame::kGlobalTerrain, 50),
            number(kUnsupportedFrame));
  EXPECT_EQ(s.result(CommandId::kReposition, {-1, 1, 0, 0, 47, 8, 80}), number(kIntOnly));
}

TEST(Reposition, ChangesTheModeWhenItMay) {
  Station s;
  VehicleSnapshot snapshot = flying();
  snapshot.condition.mode = VehicleMode::kHold;
  s.show(snapshot);
  EXPECT_EQ(reposition(s, {-1, 0}, CoordinateFrame::kGlobal, 550),
            number(kTemporarilyRejected));
  EXPECT_EQ(reposition(s, {-1, 1}, CoordinateFrame::kGlobal, 550), 0);
  const auto requests = s.server.take_requests();
  ASSERT_EQ(requests.size(), 2U);
  EXPECT_EQ(std::get<ModeRequest>(requests[0]).mode, VehicleMode::kGuided);
  EXPECT_TRUE(std::holds_alternative<FlyToRequest>(requests[1]));
  // Another at once, before the simulation shows the mode.
  EXPECT_EQ(reposition(s, {-1, 0}, CoordinateFrame::kGlobal, 560), 0);
}

TEST(Reposition, IsForArmedVehiclesInTheAir) {
  Station s;
  VehicleSnapshot snapshot = standing();
  snapshot.condition.mode = VehicleMode::kGuided;
  s.show(snapshot);
  EXPECT_EQ(reposition(s, {-1, 1}, CoordinateFrame::kGlobal, 550),
            number(kTemporarilyRejected));
  EXPECT_EQ(s.texts()[0], "Reposition: it is not armed");
  snapshot.condition.armed = true;
  s.show(snapshot);
  EXPECT_EQ(reposition(s, {-1, 1}, CoordinateFrame::kGlobal, 551),
            number(kTemporarilyRejected));
  EXPECT_EQ(s.texts()[0], "Reposition: it has not taken off");
  EXPECT_TRUE(s.server.take_requests().empty());
}

TEST(Reposition, WithoutAPlaceStaysOrChangesTheAltitude) {
  Station s(Make::kPx4, true);
  VehicleSnapshot snapshot = flying();
  snapshot.condition.mode = VehicleMode::kMission;
  s.show(snapshot);
  // As ground stations pause PX4, and change its altitude.
  EXPECT_EQ(s.result(CommandId::kReposition, {-1, 1, 0, kNan, kNan, kNan, kNan}), 0);
  EXPECT_EQ(s.only_request<ModeRequest>().mode, VehicleMode::kHold);
  EXPECT_EQ(s.result(CommandId::kReposition, {-1, 1, 0, kNan, kNan, kNan, 520}), 0);
  const auto requests = s.server.take_requests();
  ASSERT_EQ(requests.size(), 2U);
  EXPECT_EQ(std::get<FlyToRequest>(requests[1]).p_N, Vec3(300, 250, -520));
  snapshot.condition.mode = VehicleMode::kGuided;
  s.show(snapshot);
  EXPECT_EQ(s.last<mavlink::Heartbeat>().custom_mode, 0x03040000U) << "hold";
}

TEST(PositionTarget, APlaceIsFlownToOnce) {
  Station s;
  s.show(flying());
  for (int k = 0; k < 10; ++k) s.send(global_target(kPlaceOnly));
  const auto request = s.only_request<FlyToRequest>();
  EXPECT_NEAR((geo::horizontal(request.p_N) - place()).norm(), 0, 0.02);
  EXPECT_DOUBLE_EQ(request.p_N.z(), -520);
  auto m = local_target(CoordinateFrame::kLocalNed, kPlaceOnly);
  m.x = 10;
  m.y = -20;
  m.z = -30;  // from where home was
  s.send(m);
  EXPECT_EQ(s.only_request<FlyToRequest>().p_N, Vec3(110, 180, -430));
  m.coordinate_frame = static_cast<std::uint8_t>(CoordinateFrame::kLocalOffsetNed);
  s.send(m);
  EXPECT_EQ(s.only_request<FlyToRequest>().p_N, Vec3(310, 230, -530));
}

TEST(PositionTarget, AnAltitudeAloneKeepsThePlace) {
  Station s;
  s.show(flying());
  s.send(global_target(kPlaceOnly));
  const Vec3 before = s.only_request<FlyToRequest>().p_N;
  auto m = global_target(kAltitudeOnly);
  m.alt = 150;
  s.send(m);
  EXPECT_EQ(s.only_request<FlyToRequest>().p_N, Vec3(before.x(), before.y(), -550));
  // As ground stations change an ArduPilot's altitude, with every other bit set.
  auto offset = local_target(CoordinateFrame::kLocalOffsetNed, 0xfff8);
  offset.z = -25;
  s.send(offset);
  EXPECT_EQ(s.only_request<FlyToRequest>().p_N, Vec3(before.x(), before.y(), -525));
}

TEST(PositionTarget, WithAVelocityItIsATrajectory) {
  Station s;
  s.show(flying());
  auto m = global_target(kAll);
  m.vx = 14;
  m.vy = 3;
  m.vz = -1;
  m.afy = 0.5;
  m.yaw = 1;
  s.send(m);
  const auto all = s.only_request<TrackSetpoint>();
  EXPECT_NEAR((geo::horizontal(all.p_N) - place()).norm(), 0, 0.02);
  EXPECT_DOUBLE_EQ(all.p_N.z(), -520);
  EXPECT_EQ(all.v_N, Vec3(14, 3, -1));
  EXPECT_EQ(all.a_N, Vec3(0, 0.5, 0));
  EXPECT_EQ(all.heading, 1);
  m.type_mask = kPlaceAndVelocity;
  s.send(m);
  const auto some = s.only_request<TrackSetpoint>();
  EXPECT_EQ(some.a_N, Vec3::Zero());
  EXPECT_FALSE(some.heading);
}

TEST(PositionTarget, AVelocityAloneIsFlownFromWhereItIs) {
  Station s(Make::kPx4, true);
  VehicleSnapshot snapshot = flying();
  snapshot.motion.q_NB = geo::from_euler({0, 0, geo::radians(90)});
  s.show(snapshot);
  auto m = local_target(CoordinateFrame::kLocalNed, kVelocityOnly);
  m.vx = 3;
  m.vz = 1;
  s.send(m);
  const auto north = s.only_request<TrackSetpoint>();
  EXPECT_EQ(north.p_N, snapshot.motion.p_N);
  EXPECT_EQ(north.v_N, Vec3(3, 0, 1));
  m.coordinate_frame = static_cast<std::uint8_t>(CoordinateFrame::kBodyNed);
  s.send(m);
  const auto ahead = s.only_request<TrackSetpoint>();
  EXPECT_NEAR((ahead.v_N - Vec3(0, 3, 1)).norm(), 0, 1e-12) << "it heads east";
}

TEST(PositionTarget, TheNewestReplacesThoseThatWereNotTaken) {
  Station s;
  s.show(flying());
  auto m = local_target(CoordinateFrame::kLocalNed, kVelocityOnly);
  for (int k = 0; k < 500; ++k) {
    m.vx = static_cast<float>(k);
    s.send(m);
  }
  EXPECT_EQ(s.only_request<TrackSetpoint>().v_N.x(), 499);
}

TEST(PositionTarget, IsPassedOverWhereItMeansNothing) {
  Station s;
  s.show(flying());
  s.clear();
  auto m = global_target(kPlaceAndVelocity);
  m.coordinate_frame = 10;
  s.send(m);  // above the ground there
  m = global_target(kPlaceAndVelocity);
  m.vx = kNan;
  s.send(m);
  m.vx = 1e30F;
  s.send(m);
  m = global_target(kPlaceAndVelocity);
  m.lat_int = -470'000'000;
  s.send(m);
  s.send(global_target(0x0fff));  // all left out
  auto local = local_target(CoordinateFrame::kGlobalRelative, kPlaceOnly);
  s.send(local);
  m = global_target(kPlaceAndVelocity);
  m.target_system = 0;
  s.send(m);  // for all
  EXPECT_TRUE(s.server.take_requests().empty());
  EXPECT_TRUE(s.frames.empty());
}

TEST(PositionTarget, IsPassedOverUnlessGuidedAndArmed) {
  for (const VehicleMode mode :
       {VehicleMode::kHold, VehicleMode::kMission, VehicleMode::kReturn}) {
    Station s;
    VehicleSnapshot snapshot = flying();
    snapshot.condition.mode = mode;
    s.show(snapshot);
    s.send(global_target(kPlaceAndVelocity));
    s.send(global_target(kPlaceOnly));
    mavlink::SetAttitudeTarget attitude;
    attitude.target_system = 7;
    attitude.q = {1, 0, 0, 0};
    s.send(attitude);
    EXPECT_TRUE(s.server.take_requests().empty());
  }
}

mavlink::SetAttitudeTarget bank(double roll) {
  const Quat q = geo::from_euler({roll, 0.1, 1});
  mavlink::SetAttitudeTarget m;
  m.target_system = 7;
  m.target_component = 1;
  m.q = {static_cast<float>(q.w()), static_cast<float>(q.x()), static_cast<float>(q.y()),
         static_cast<float>(q.z())};
  return m;
}

TEST(AttitudeTarget, IsABankAtTheAltitudeThatWasCommanded) {
  Station s;
  s.show(flying());
  s.send(bank(0.4));
  auto setpoint = s.only_request<BankSetpoint>();
  EXPECT_NEAR(setpoint.roll, 0.4, 1e-6);
  EXPECT_EQ(setpoint.altitude_msl, 500) << "as it was";
  EXPECT_EQ(setpoint.climb_rate, 0);
  EXPECT_EQ(setpoint.airspeed, 20);
  EXPECT_EQ(s.command_int(CommandId::kGuidedAltitude, {0, 0, 2},
                          CoordinateFrame::kGlobalRelative, 0, 0, 150)
                .result,
            0);
  EXPECT_TRUE(s.server.take_requests().empty()) << "the next bank says so";
  EXPECT_EQ(s.result(CommandId::kGuidedSpeed, {0, 22}), 0);
  s.server.take_requests();
  s.send(bank(-0.2));
  setpoint = s.only_request<BankSetpoint>();
  EXPECT_NEAR(setpoint.roll, -0.2, 1e-6);
  EXPECT_EQ(setpoint.altitude_msl, 550);
  EXPECT_EQ(setpoint.climb_rate, 2);
  EXPECT_EQ(setpoint.airspeed, 22);
  s.send(global_target(kPlaceOnly));
  s.server.take_requests();
  s.send(bank(0));
  EXPECT_EQ(s.only_request<BankSetpoint>().altitude_msl, 520) << "of the place";
}

TEST(AttitudeTarget, IsPassedOverWhereItIsNone) {
  Station s;
  s.show(flying());
  auto m = bank(0.4);
  m.type_mask = 128;
  s.send(m);
  m = bank(0.4);
  m.q = {0, 0, 0, 0};
  s.send(m);
  m.q = {kNan, 0, 0, 0};
  s.send(m);
  EXPECT_TRUE(s.server.take_requests().empty());
  Station multirotor(Make::kArduPilot, true);
  multirotor.show(flying());
  multirotor.send(bank(0.4));
  EXPECT_TRUE(multirotor.server.take_requests().empty());
}

TEST(AttitudeTarget, GivesTheRollAloneAsArduPilotTakesIt) {
  Station s;
  s.show(flying());
  auto m = bank(0.4);
  m.type_mask = 0b1100'0110;
  s.send(m);
  EXPECT_NEAR(s.only_request<BankSetpoint>().roll, 0.4, 1e-6);
}

TEST(GuidedCommands, ChangeTheAltitudeOfThePlace) {
  Station s;
  s.show(flying());
  EXPECT_EQ(
      s.command_int(CommandId::kGuidedAltitude, {}, CoordinateFrame::kGlobal, 0, 0, 540)
          .result,
      0);
  EXPECT_EQ(s.only_request<FlyToRequest>().p_N, Vec3(300, 250, -540));
  EXPECT_EQ(s.result(CommandId::kGuidedAltitude, {0, 0, 0, 0, 0, 0, 540}),
            number(kIntOnly));
  EXPECT_EQ(s.command_int(CommandId::kGuidedAltitude, {}, CoordinateFrame::kGlobalTerrain,
                          0, 0, 540)
                .result,
            number(kUnsupportedFrame));
}

TEST(GuidedCommands, AreForArduPilotsPlanes) {
  for (const auto& [make, hovers] :
       {std::pair{Make::kArduPilot, true}, {Make::kPx4, false}, {Make::kPx4, true}}) {
    Station s(make, hovers);
    s.show(flying());
    EXPECT_EQ(s.result(CommandId::kGuidedSpeed, {0, 20}), number(kUnsupported));
    EXPECT_EQ(s.result(CommandId::kGuidedHeading, {0, 20}), number(kUnsupported));
  }
  Station s;
  VehicleSnapshot snapshot = flying();
  snapshot.condition.mode = VehicleMode::kHold;
  s.show(snapshot);
  EXPECT_EQ(s.result(CommandId::kGuidedSpeed, {0, 20}), number(kTemporarilyRejected));
}

TEST(GuidedCommands, KeepAHeadingInTheWind) {
  for (const bool over_ground : {true, false}) {
    Station s;
    VehicleSnapshot snapshot = flying();
    snapshot.motion.wind_N = {-6, 0};  // from the north
    s.show(snapshot);
    EXPECT_EQ(s.result(CommandId::kGuidedHeading, {over_ground ? 0.F : 1.F, 90}), 0);
    s.run(1);
    const auto setpoint = s.only_request<TrackSetpoint>();
    EXPECT_NEAR(setpoint.v_N.x(), over_ground ? 0 : -6, 1e-9);
    EXPECT_NEAR(setpoint.v_N.y(), over_ground ? std::sqrt(20. * 20 - 36) : 20, 1e-9);
    EXPECT_EQ(setpoint.p_N, snapshot.motion.p_N);
    s.run(1);
    EXPECT_EQ(s.server.take_requests().size(), 1U) << "on and on";
    // Until something else is commanded.
    EXPECT_EQ(reposition(s, {}, CoordinateFrame::kGlobal, 500), 0);
    s.server.take_requests();
    s.run(1);
    EXPECT_TRUE(s.server.take_requests().empty());
  }
}

TEST(GuidedCommands, EndWithTheMode) {
  Station s;
  s.show(flying());
  EXPECT_EQ(s.result(CommandId::kGuidedHeading, {0, 90}), 0);
  EXPECT_EQ(s.result(CommandId::kReturn), 0);
  s.server.take_requests();
  s.run(1);
  EXPECT_TRUE(s.server.take_requests().empty());
}

TEST(GuidedItems, GoThereOrChangeTheAltitude) {
  Station s;
  s.show(flying());
  mavlink::MissionItemInt m;
  m.target_system = 7;
  m.target_component = 1;
  m.current = 2;
  m.command = 16;
  m.frame = 6;
  m.x = degrees_e7(kLatitude);
  m.y = degrees_e7(kLongitude);
  m.z = 90;
  s.send(m);
  EXPECT_EQ(s.last<mavlink::MissionAck>().type, 0);
  const auto there = s.only_request<FlyToRequest>();
  EXPECT_NEAR((geo::horizontal(there.p_N) - place()).norm(), 0, 0.02);
  mavlink::MissionItem floats;
  floats.target_system = 7;
  floats.target_component = 1;
  floats.current = 3;
  floats.frame = 3;
  floats.z = 70;
  s.send(floats);
  EXPECT_EQ(s.only_request<FlyToRequest>().p_N, Vec3(there.p_N.x(), there.p_N.y(), -470));
  VehicleSnapshot snapshot = flying();
  snapshot.condition.mode = VehicleMode::kHold;
  s.show(snapshot);
  s.send(m);
  EXPECT_EQ(s.last<mavlink::MissionAck>().type, int(mavlink::MissionResult::kDenied));
}

}  // namespace
}  // namespace skein::vehicle_services::guided_test
