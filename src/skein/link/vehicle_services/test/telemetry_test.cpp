// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "skein/link/mavlink/flight_modes.h"
#include "skein/link/vehicle_services/mode_table.h"
#include "skein/link/vehicle_services/test/station.h"

namespace skein::vehicle_services::telemetry_test {
namespace {

using mavlink::CommandId;
using mavlink::CommandResult;
using mavlink::kModeArmed;

TEST(Heartbeat, IsSentEachSecondOfTheWallClockWhateverTheRunDoes) {
  Station s;
  s.run(10, false);  // before the simulation says anything
  EXPECT_EQ(s.heard<mavlink::Heartbeat>().size(), 11U);
  EXPECT_EQ(s.last<mavlink::Heartbeat>().system_status, 1) << "boot";
  s.show(standing());
  s.clear();
  VehicleSnapshot paused = standing();
  paused.paused = true;
  s.show(paused);
  s.run(10, false);
  EXPECT_NEAR(static_cast<double>(s.heard<mavlink::Heartbeat>().size()), 10, 1);
  EXPECT_TRUE(s.heard<mavlink::Attitude>().empty()) << "the run's clock stands";
}

TEST(Heartbeat, SaysWhatItIsAndWhatItDoes) {
  struct Case {
    Make make;
    bool hovers;
    VehicleMode mode;
    std::uint32_t number;
    std::uint8_t flags;
  };
  for (const auto& [make, hovers, mode, number, flags] : {
           Case{Make::kArduPilot, false, VehicleMode::kMission, 10, 29},
           {Make::kArduPilot, false, VehicleMode::kGuided, 15, 25},
           {Make::kArduPilot, false, VehicleMode::kStabilized, 5, 81},
           {Make::kArduPilot, true, VehicleMode::kMission, 3, 29},
           {Make::kArduPilot, true, VehicleMode::kTakeOff, 4, 29},
           {Make::kPx4, true, VehicleMode::kReturn, 0x05040000, 29},
           {Make::kPx4, false, VehicleMode::kGuided, 0x00060000, 25},
           {Make::kPx4, false, VehicleMode::kManual, 0x00010000, 65},
       }) {
    Station s(make, hovers);
    VehicleSnapshot snapshot = flying();
    snapshot.condition.mode = mode;
    s.show(snapshot);
    const auto m = s.last<mavlink::Heartbeat>();
    EXPECT_EQ(m.custom_mode, number);
    EXPECT_EQ(m.base_mode, flags | kModeArmed) << number;
    EXPECT_EQ(m.autopilot, make == Make::kPx4 ? 12 : 3);
    EXPECT_EQ(m.type, hovers ? 2 : 1);
    EXPECT_EQ(m.mavlink_version, 3);
    EXPECT_EQ(m.system_status, 4);
  }
}

TEST(Heartbeat, ComesAtOnceWhenSomethingChanges) {
  Station s;
  s.show(standing());
  s.run(0.5);
  s.clear();
  VehicleSnapshot armed = standing();
  armed.condition.armed = true;
  s.show(armed);
  ASSERT_EQ(s.heard<mavlink::Heartbeat>().size(), 1U);
  EXPECT_EQ(s.last<mavlink::Heartbeat>().base_mode & kModeArmed, kModeArmed);
}

TEST(Heartbeat, HasTheStateOfTheVehicle) {
  Station s;
  s.show(standing());
  EXPECT_EQ(s.last<mavlink::Heartbeat>().system_status, 3) << "standby";
  VehicleSnapshot snapshot = flying();
  snapshot.condition.charge = 0.05;
  s.show(snapshot);
  EXPECT_EQ(s.last<mavlink::Heartbeat>().system_status, 5) << "critical";
  snapshot.condition.emergency = true;
  s.show(snapshot);
  EXPECT_EQ(s.last<mavlink::Heartbeat>().system_status, 6) << "emergency";
}

TEST(ModeTable, EveryMakeShowsEveryModeAndNumbersMeanOneMode) {
  for (const Make make : {Make::kArduPilot, Make::kPx4})
    for (const bool hovers : {false, true}) {
      std::set<std::uint32_t> selectable;
      for (const ModeRow& row : modes_of(make, hovers)) {
        if (!row.selectable) continue;
        EXPECT_TRUE(selectable.insert(row.number).second) << row.name;
        EXPECT_EQ(find_mode(row.number, make, hovers), &row) << row.name;
      }
      for (std::size_t k = 0; k < names_of(static_cast<VehicleMode*>(nullptr)).size();
           ++k) {
        const auto mode = static_cast<VehicleMode>(k);
        EXPECT_EQ(row_of(mode, make, hovers).mode, mode);
      }
    }
}

TEST(ModeTable, MeansWhatItMeansToWhoCommandsRealVehicles) {
  for (const auto& [make, of_messages] :
       {std::pair{Make::kArduPilot, mavlink::Make::kArduPilot},
        {Make::kPx4, mavlink::Make::kPx4}})
    for (const bool hovers : {false, true})
      for (const ModeRow& row : modes_of(make, hovers)) {
        const VehicleMode mode = mavlink::mode_of(of_messages, hovers, row.number);
        if (row.selectable && mode != VehicleMode::kOther) {
          EXPECT_EQ(mode, row.mode) << row.name;
        }
      }
}

TEST(Telemetry, SaysWhereItIsAndHowItMoves) {
  Station s;
  VehicleSnapshot snapshot = flying();
  snapshot.motion.v_N = {12, -16, -3};
  snapshot.motion.q_NB = geo::from_euler({0.3, -0.1, geo::radians(350)});
  snapshot.motion.w_NB_B = {0.01, 0.02, 0.03};
  snapshot.motion.wind_N = {0, 5};  // from the west
  snapshot.throttle = 0.6;
  s.show(snapshot);
  s.run(5);
  const auto g = s.last<mavlink::GlobalPositionInt>();
  const Vec2 back = test_frame().to_plane(g.lat * 1e-7, g.lon * 1e-7);
  EXPECT_NEAR(back.x(), 300, 0.02);  // 1e-7 degrees are 11 mm
  EXPECT_NEAR(back.y(), 250, 0.02);
  EXPECT_EQ(g.alt, 500'000);
  EXPECT_EQ(g.relative_alt, 100'000);
  EXPECT_EQ(g.vx, 1200);
  EXPECT_EQ(g.vy, -1600);
  EXPECT_EQ(g.vz, -300);
  EXPECT_EQ(g.hdg, 35'000);
  const auto local = s.last<mavlink::LocalPositionNed>();
  EXPECT_FLOAT_EQ(local.x, 200);  // from home
  EXPECT_FLOAT_EQ(local.y, 50);
  EXPECT_FLOAT_EQ(local.z, -100);
  const auto a = s.last<mavlink::Attitude>();
  EXPECT_NEAR(a.roll, 0.3F, 1e-6F);
  EXPECT_NEAR(a.pitch, -0.1F, 1e-6F);
  EXPECT_FLOAT_EQ(a.yawspeed, 0.03F);
  const auto hud = s.last<mavlink::VfrHud>();
  EXPECT_FLOAT_EQ(hud.groundspeed, 20);
  EXPECT_FLOAT_EQ(hud.airspeed, 20);
  EXPECT_FLOAT_EQ(hud.climb, 3);
  EXPECT_FLOAT_EQ(hud.alt, 500);
  EXPECT_EQ(hud.heading, 350);
  EXPECT_EQ(hud.throttle, 60);
  const auto gps = s.last<mavlink::GpsRawInt>();
  EXPECT_EQ(gps.fix_type, 3);
  EXPECT_EQ(gps.h_acc, 1500U);
  EXPECT_EQ(gps.eph, 75);
  EXPECT_EQ(gps.v_acc, 2500U);
  EXPECT_EQ(gps.epv, 125);
  EXPECT_EQ(gps.vel, 2000);
  EXPECT_EQ(gps.cog, 30'687);  // atan2(-16, 12)
  EXPECT_EQ(gps.satellites_visible, 255);
  const auto wind = s.last<mavlink::Wind>();
  EXPECT_NEAR(wind.direction, 270, 1e-4F);
  EXPECT_FLOAT_EQ(wind.speed, 5);
  EXPECT_EQ(s.last<mavlink::ServoOutputRaw>().servo3_raw, 1600);
}

TEST(Telemetry, MarksWhatIsNotKnown) {
  Station s(Make::kPx4, false);
  VehicleSnapshot snapshot = standing();
  snapshot.condition.position = false;
  snapshot.not_ready = "no position";
  s.show(snapshot);
  s.run(5);
  const auto gps = s.last<mavlink::GpsRawInt>();
  EXPECT_EQ(gps.fix_type, 1);
  EXPECT_EQ(gps.lat, 0);
  EXPECT_EQ(gps.eph, 65'535);
  EXPECT_EQ(gps.cog, 65'535);
  const auto sys = s.last<mavlink::SysStatus>();
  EXPECT_EQ(sys.voltage_battery, 65'535);
  EXPECT_EQ(sys.current_battery, -1);
  EXPECT_EQ(sys.battery_remaining, 80);
  EXPECT_EQ(sys.onboard_control_sensors_health & mavlink::sensor_bit::kGps, 0U);
  EXPECT_EQ(sys.onboard_control_sensors_health & mavlink::sensor_bit::kPreArmCheck, 0U);
  EXPECT_NE(sys.onboard_control_sensors_present & mavlink::sensor_bit::kGps, 0U);
  const auto battery = s.last<mavlink::BatteryStatus>();
  for (const auto cell : battery.voltages) EXPECT_EQ(cell, 65'535);
  EXPECT_EQ(battery.temperature, 32'767);
  EXPECT_EQ(battery.current_consumed, -1);
  const auto home = s.last<mavlink::HomePosition>();
  EXPECT_TRUE(std::isnan(home.q[0]));
  EXPECT_EQ(home.altitude, 400'000);
  const auto wind = s.last<mavlink::WindCov>();
  EXPECT_TRUE(std::isnan(wind.var_horiz));
  const auto rc = s.last<mavlink::RcChannels>();
  EXPECT_EQ(rc.chancount, 0);
  EXPECT_EQ(rc.chan1_raw, 65'535);
  EXPECT_EQ(rc.rssi, 255);
  EXPECT_EQ(s.last<mavlink::EstimatorStatus>().flags & 16, 0);
}

TEST(Telemetry, SpreadsAHighVoltageOverCells) {
  Station s;
  VehicleSnapshot snapshot = flying();
  snapshot.condition.voltage = 88;
  snapshot.condition.current = 12.5;
  s.show(snapshot);
  s.run(4);
  const auto battery = s.last<mavlink::BatteryStatus>();
  EXPECT_EQ(battery.voltages[0] + battery.voltages[1], 88'000);
  EXPECT_EQ(battery.voltages[2], 65'535);
  EXPECT_EQ(battery.current_battery, 1250);
  EXPECT_EQ(s.last<mavlink::SysStatus>().voltage_battery, 65'534) << "what fits";
}

TEST(Telemetry, SaysWhetherItIsInTheAir) {
  Station s;
  s.show(standing());
  EXPECT_EQ(s.last<mavlink::ExtendedSysState>().landed_state, 1);
  VehicleSnapshot snapshot = flying();
  for (const auto& [mode, state] : {std::pair{VehicleMode::kTakeOff, 3},
                                    {VehicleMode::kMission, 2},
                                    {VehicleMode::kLand, 4}}) {
    snapshot.condition.mode = mode;
    s.show(snapshot);
    EXPECT_EQ(s.last<mavlink::ExtendedSysState>().landed_state, state);
  }
}

TEST(Telemetry, TheLocalAxesStayWhenHomeMoves) {
  Station s;
  s.show(standing());
  VehicleSnapshot moved = standing();
  moved.home_N = {0, 0, -410};
  s.clear();
  s.show(moved);
  const auto home = s.last<mavlink::HomePosition>();
  EXPECT_FLOAT_EQ(home.x, -100);
  EXPECT_FLOAT_EQ(home.y, -200);
  EXPECT_FLOAT_EQ(home.z, -10);
  EXPECT_EQ(s.result(CommandId::kRequestMessage, {49}), 0);
  EXPECT_EQ(s.last<mavlink::GpsGlobalOrigin>().altitude, 400'000);
}

std::map<std::uint32_t, int> counts(const Station& s) {
  std::map<std::uint32_t, int> all;
  for (const auto& h : s.frames)
    mavlink::FrameParser().read(h.bytes, [&](const mavlink::Frame& f) { ++all[f.id()]; });
  return all;
}

TEST(TelemetryStreams, RunAtTheRatesOfTheirOwnByTheRunsClock) {
  Station s;
  s.show(flying());
  s.run(1);
  s.clear();
  s.run(20);
  auto all = counts(s);
  EXPECT_NEAR(all[30], 200, 2);
  EXPECT_NEAR(all[33], 100, 2);
  EXPECT_NEAR(all[74], 80, 2);
  EXPECT_NEAR(all[1], 20, 1);
  EXPECT_NEAR(all[24], 40, 1);
  EXPECT_NEAR(all[147], 10, 1);
  EXPECT_NEAR(all[242], 10, 1);
  EXPECT_NEAR(all[245], 20, 1);
  for (const std::uint32_t id : {2, 36, 42, 62, 65, 168, 193, 241})
    EXPECT_NEAR(all[id], 20, 1) << id;
  EXPECT_EQ(all[31], 0) << "only when asked for";
  EXPECT_EQ(all[230], 0) << "of another make";
}

TEST(TelemetryStreams, AreSetOneByOne) {
  Station s;
  s.show(flying());
  EXPECT_EQ(s.result(CommandId::kSetMessageInterval, {30, 20'000}), 0);
  EXPECT_EQ(s.result(CommandId::kSetMessageInterval, {33, -1}), 0);
  EXPECT_EQ(s.result(CommandId::kSetMessageInterval, {31, 500'000}), 0);
  EXPECT_EQ(s.result(CommandId::kSetMessageInterval, {230, 500'000}),
            number(CommandResult::kUnsupported));
  EXPECT_EQ(s.result(CommandId::kSetMessageInterval, {0, 500'000}),
            number(CommandResult::kUnsupported))
      << "the heartbeat's rate is fixed";
  s.run(1);
  s.clear();
  s.run(10);
  auto all = counts(s);
  EXPECT_NEAR(all[30], 500, 2);
  EXPECT_EQ(all[33], 0);
  EXPECT_NEAR(all[31], 20, 1);
  const auto interval = [&](float id) {
    EXPECT_EQ(s.result(CommandId::kGetMessageInterval, {id}), 0);
    return s.last<mavlink::MessageInterval>().interval_us;
  };
  EXPECT_EQ(interval(30), 20'000);
  EXPECT_EQ(interval(33), -1);
  EXPECT_EQ(interval(0), 1'000'000);
  EXPECT_EQ(interval(9999), 0) << "there is none";
  EXPECT_EQ(s.result(CommandId::kSetMessageInterval, {33, 0}), 0);
  EXPECT_EQ(interval(33), 200'000) << "its own again";
}

TEST(TelemetryStreams, AreSetInGroupsForEachLinkByItself) {
  Station s;
  s.server.open(2, s.now);
  s.show(flying());
  mavlink::RequestDataStream request;
  request.target_system = 7;
  request.req_stream_id = 10;
  request.req_message_rate = 2;
  request.start_stop = 1;
  s.send(request);
  s.run(1);
  s.clear();
  // Asked for again and again, as ground stations do.
  for (int k = 0; k < 100; ++k) {
    s.run(0.1);
    s.send(request);
  }
  EXPECT_NEAR(static_cast<double>(s.heard<mavlink::Attitude>(1).size()), 20, 1);
  EXPECT_NEAR(static_cast<double>(s.heard<mavlink::Attitude>(2).size()), 100, 2);
  request.req_stream_id = 0;
  request.start_stop = 0;
  s.send(request);
  s.clear();
  s.run(10);
  EXPECT_TRUE(s.heard<mavlink::Attitude>(1).empty());
  EXPECT_TRUE(s.heard<mavlink::SysStatus>(1).empty());
  EXPECT_FALSE(s.heard<mavlink::HomePosition>(1).empty()) << "of no group";
}

TEST(TelemetryStreams, DoNotFloodALinkWhenTheRunIsFast) {
  Station s;
  s.show(flying());
  s.clear();
  for (int k = 0; k < 1000; ++k) {  // a thousand times real time, for 10 s
    s.now.wall += Time::from_seconds(0.01);
    s.now.simulated += Time::from_seconds(10);
    s.step();
  }
  EXPECT_NEAR(static_cast<double>(s.heard<mavlink::Attitude>().size()), 1000, 10);
  EXPECT_NEAR(static_cast<double>(s.heard<mavlink::SysStatus>().size()), 100, 2);
}

TEST(TelemetryStreams, GoOnWhenTheRunBeginsAnew) {
  Station s;
  s.show(flying());
  s.run(100);
  s.clear();
  s.now.simulated = Time();
  s.run(2);
  EXPECT_NEAR(static_cast<double>(s.heard<mavlink::Attitude>().size()), 20, 2);
  ASSERT_EQ(s.texts().size(), 1U);
  EXPECT_NE(s.texts()[0].find("kestrel"), std::string::npos) << "it was switched on";
}

TEST(Announcements, SayWhoItIsAndWhenTheRunPauses) {
  Station s;
  s.step();
  ASSERT_EQ(s.texts().size(), 1U);
  EXPECT_EQ(s.texts()[0], "kestrel: simulated fixed wing, Skein 0.1.0");
  s.show(standing());
  s.clear();
  VehicleSnapshot paused = standing();
  paused.paused = true;
  for (int k = 0; k < 3; ++k) s.show(paused);
  EXPECT_EQ(s.texts(), (std::vector<std::string>{"Simulation paused"}));
  for (int k = 0; k < 3; ++k) s.show(standing());
  EXPECT_EQ(s.texts().back(), "Simulation goes on");
  EXPECT_EQ(s.texts().size(), 2U);
}

TEST(Announcements, LongTextsComeInParts) {
  Station s;
  s.step();
  for (const std::size_t length : {49U, 50U, 51U, 100U, 120U}) {
    s.clear();
    s.server.say(mavlink::Severity::kError, std::string(length, 'x'));
    s.step();
    std::string all;
    const auto parts = s.heard<mavlink::Statustext>();
    for (std::size_t k = 0; k < parts.size(); ++k) {
      all += mavlink::text_of(parts[k].text);
      EXPECT_EQ(parts[k].severity, 3);
      EXPECT_EQ(parts[k].id != 0, length > 50);
      EXPECT_EQ(parts[k].chunk_seq, k);
    }
    EXPECT_EQ(all.size(), length);
    // The last part has a zero in it, where there are several.
    if (length > 50) {
      EXPECT_LT(mavlink::text_of(parts.back().text).size(), 50U);
    }
  }
}

TEST(Identity, DiffersBetweenVehiclesAndStaysBetweenRuns) {
  std::set<std::uint64_t> serial_numbers;
  for (std::uint32_t index = 0; index < 600; ++index) {
    VehicleServerOptions options = test_options(Make::kArduPilot, false);
    options.seed = 12;
    options.index = index;
    Station s(options);
    EXPECT_EQ(s.result(CommandId::kRequestMessage, {148}), 0);
    const auto m = s.last<mavlink::AutopilotVersion>();
    EXPECT_TRUE(serial_numbers.insert(m.uid).second);
    Station again(options);
    again.command(CommandId::kRequestMessage, {148});
    EXPECT_EQ(again.last<mavlink::AutopilotVersion>().uid2, m.uid2);
  }
}

TEST(Identity, PromisesOnlyWhatItKeeps) {
  for (const Make make : {Make::kArduPilot, Make::kPx4})
    for (const bool hovers : {false, true}) {
      Station s(make, hovers);
      EXPECT_EQ(s.result(CommandId::kRequestCapabilities, {1}), 0);
      const auto bits = s.last<mavlink::AutopilotVersion>().capabilities;
      using namespace mavlink::capability;
      EXPECT_EQ(bits & kSetAttitudeTarget, hovers ? 0 : kSetAttitudeTarget);
      EXPECT_EQ((bits & kParamEncodeBytes) != 0, make == Make::kPx4);
      EXPECT_EQ((bits & kParamEncodeCast) != 0, make == Make::kArduPilot);
      EXPECT_EQ(bits & 32, 0U) << "no file transfer";
      for (const auto bit :
           {kMissionInt, kCommandInt, kMavlink2, kMissionFence, kMissionRally,
            kSetPositionTargetLocal, kSetPositionTargetGlobal})
        EXPECT_NE(bits & bit, 0U) << bit;
    }
}

TEST(Identity, ListsItsModes) {
  Station s(Make::kArduPilot, true);
  s.show(standing());
  EXPECT_EQ(s.result(CommandId::kRequestMessage, {435, 0}), 0);
  const auto modes = s.heard<mavlink::AvailableModes>();
  ASSERT_EQ(modes.size(), 8U);
  for (std::size_t k = 0; k < modes.size(); ++k) {
    EXPECT_EQ(modes[k].number_modes, 8);
    EXPECT_EQ(modes[k].mode_index, k + 1);
  }
  EXPECT_EQ(s.result(CommandId::kRequestMessage, {435, 5}), 0);
  ASSERT_EQ(s.heard<mavlink::AvailableModes>().size(), 1U);
  EXPECT_EQ(mavlink::text_of(s.last<mavlink::AvailableModes>().mode_name), "GUIDED");
  EXPECT_EQ(s.result(CommandId::kRequestMessage, {435, 9}),
            number(CommandResult::kUnsupported));
  EXPECT_EQ(s.result(CommandId::kRequestMessage, {436}), 0);
  EXPECT_EQ(s.last<mavlink::CurrentMode>().custom_mode, 5U);
}

}  // namespace
}  // namespace skein::vehicle_services::telemetry_test
