// SPDX-License-Identifier: Apache-2.0
#include "skein/link/autopilot_client/command_sender.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "skein/link/autopilot_client/request_steps.h"
#include "skein/link/mavlink/payload.h"
#include "skein/link/vehicle_services/test/bad_line.h"

namespace skein::autopilot_client::command_sender_test {
namespace {

using Outcome = RequestAnswer::Outcome;

// A sender, and a vehicle that answers what is sent as the test says.
struct Exchange {
  CommandSender sender{1};
  Time now = Time::from_seconds(100);
  std::function<void(const mavlink::Frame&)> vehicle;
  int sent = 0;
  std::vector<std::vector<std::byte>> under_way;
  vehicle_services::Outbox out{245, 191, [this](auto, auto bytes) {
                                 ++sent;
                                 under_way.emplace_back(bytes.begin(), bytes.end());
                               }};

  void step() {
    sender.step(now, 1, out);
    for (const auto& bytes : std::exchange(under_way, {}))
      mavlink::FrameParser().read(bytes, [this](const mavlink::Frame& frame) {
        if (vehicle) vehicle(frame);
      });
  }

  // Until it is answered.
  RequestAnswer run(std::vector<RequestStep> steps, double seconds = 30) {
    sender.add({7, std::move(steps)});
    std::vector<RequestAnswer> answers;
    for (double t = 0; t < seconds && answers.empty(); t += 0.1) {
      now = now + Time::from_seconds(0.1);
      step();
      answers = sender.take_answers();
    }
    return answers.empty() ? RequestAnswer{} : answers.front();
  }

  void acknowledge(std::uint16_t command, std::uint8_t result) {
    mavlink::CommandAck ack;
    ack.command = command;
    ack.result = result;
    sender.handle(ack, now);
  }
  // It stores parameters as ArduPilot does: numbers cast to their types.
  void keeps(std::uint8_t type, double least, double greatest) {
    vehicle = [=, this](const mavlink::Frame& frame) {
      vehicle_services::on<mavlink::ParamSet>(frame, [&](const mavlink::ParamSet& set) {
        mavlink::ParamValue value;
        value.param_id = set.param_id;
        value.param_type = type;
        const double asked = std::min(std::max(double{set.param_value}, least), greatest);
        value.param_value = static_cast<float>(type == 9 ? asked : std::trunc(asked));
        sender.handle(value);
      });
    };
  }
};

constexpr std::uint8_t kInt16 = 4, kInt32 = 6, kReal32 = 9;

TEST(CommandSender, TakesAParameterInTheTypeThatTheVehicleKeepsItIn) {
  for (const float height : {119.9F, 100.5F, 120.F, -3.7F}) {
    Exchange exchange;
    exchange.keeps(kInt16, -32768, 32767);
    EXPECT_EQ(exchange.run({SetParameter{"TKOFF_ALT", height, kReal32}}).outcome,
              Outcome::kAccepted)
        << height;
    Exchange real;
    real.keeps(kReal32, -1e9, 1e9);
    EXPECT_EQ(real.run({SetParameter{"TKOFF_ALT", height, kReal32}}).outcome,
              Outcome::kAccepted)
        << height;
  }
}

TEST(CommandSender, ReportsAParameterThatIsKeptAtAnotherValue) {
  Exchange exchange;
  exchange.keeps(kInt16, 0, 200);
  const RequestAnswer answer = exchange.run({SetParameter{"TKOFF_ALT", 250, kReal32}});
  EXPECT_EQ(answer.outcome, Outcome::kDenied);
  EXPECT_EQ(answer.text, "parameter TKOFF_ALT: 250 was requested, the vehicle keeps 200");
}

// The value that somebody else has asked for comes first.
TEST(CommandSender, WaitsForItsOwnValueOfAParameter) {
  Exchange exchange;
  int times = 0;
  exchange.vehicle = [&](const mavlink::Frame& frame) {
    vehicle_services::on<mavlink::ParamSet>(frame, [&](const mavlink::ParamSet& set) {
      mavlink::ParamValue value;
      value.param_id = set.param_id;
      value.param_type = kReal32;
      value.param_value = ++times < 2 ? 50.F : set.param_value;
      exchange.sender.handle(value);
    });
  };
  EXPECT_EQ(exchange.run({SetParameter{"TKOFF_ALT", 80, kReal32}}).outcome,
            Outcome::kAccepted);
  EXPECT_EQ(times, 2);
}

// PX4 keeps integers as bits, and takes none of another type.
TEST(CommandSender, SendsIntegersAsBitsWhereTheyAreKeptSo) {
  Exchange exchange;
  exchange.sender.set_make(mavlink::Make::kPx4);
  std::int32_t stored = 3;
  exchange.vehicle = [&](const mavlink::Frame& frame) {
    vehicle_services::on<mavlink::ParamSet>(frame, [&](const mavlink::ParamSet& set) {
      if (set.param_type == kInt32) stored = std::bit_cast<std::int32_t>(set.param_value);
      mavlink::ParamValue value;
      value.param_id = set.param_id;
      value.param_type = kInt32;
      value.param_value = std::bit_cast<float>(stored);
      exchange.sender.handle(value);
    });
  };
  EXPECT_EQ(exchange.run({SetParameter{"RTL_TYPE", 120, kReal32}}).outcome,
            Outcome::kAccepted);
  EXPECT_EQ(stored, 120);
}

TEST(CommandSender, NamesTheStepThatFailed) {
  const std::vector<RequestStep> mode = {command(kDoSetMode, 1, 4),
                                         AwaitMode{VehicleMode::kGuided, "GUIDED"}};
  Exchange exchange;
  EXPECT_EQ(exchange.run(mode).text, "mode GUIDED: not answered in 1 try")
      << "without a heartbeat nobody knows whether it had an effect";
  exchange.vehicle = [&](const mavlink::Frame&) { exchange.acknowledge(kDoSetMode, 2); };
  EXPECT_EQ(exchange.run(mode).text, "mode GUIDED: denied");
  exchange.vehicle = [&](const mavlink::Frame&) { exchange.acknowledge(kArmDisarm, 4); };
  EXPECT_EQ(exchange.run({command(kArmDisarm, 1)}).text, "arm: failed");
  exchange.vehicle = [&](const mavlink::Frame&) { exchange.acknowledge(kNavTakeOff, 3); };
  EXPECT_EQ(exchange.run({command(kNavTakeOff)}).text, "take-off: not supported");
}

TEST(CommandSender, WaitsUntilAModeThatIsAcceptedIsTaken) {
  const std::vector<RequestStep> mode = {command(kDoSetMode, 1, 4),
                                         AwaitMode{VehicleMode::kGuided, "GUIDED"}};
  Exchange exchange;
  exchange.vehicle = [&](const mavlink::Frame&) { exchange.acknowledge(kDoSetMode, 0); };
  VehicleCondition condition;
  condition.mode_name = "LOITER";
  exchange.sender.report(condition, 5, exchange.now);
  const RequestAnswer answer = exchange.run(mode);
  EXPECT_EQ(answer.outcome, Outcome::kDenied);
  EXPECT_EQ(answer.text, "mode GUIDED: accepted, but it stays in LOITER");
  condition.mode = VehicleMode::kGuided;
  exchange.sender.report(condition, 4, exchange.now);
  EXPECT_EQ(exchange.run(mode).outcome, Outcome::kAccepted);
  EXPECT_EQ(exchange.run({command(kDoSetMode, 1, 4), AwaitArmed{}}).text,
            "arm: accepted, but it stays disarmed");
}

// A multirotor of ArduPilot that does what it is sent and sends heartbeats; acknowledges
// nothing.
struct Unacknowledged {
  Exchange exchange;
  VehicleCondition condition;
  std::uint32_t number = 5;  // LOITER
  std::vector<std::uint16_t> commands;
  bool obeys = true;

  Unacknowledged() {
    exchange.sender.set_make(mavlink::Make::kArduPilot);
    condition.mode = VehicleMode::kHold;
    condition.mode_name = "LOITER";
    exchange.vehicle = [this](const mavlink::Frame& frame) {
      vehicle_services::on<mavlink::CommandLong>(frame,
                                                 [this](const auto& m) { take(m); });
      vehicle_services::on<mavlink::CommandInt>(frame,
                                                [this](const auto& m) { take(m); });
    };
    heartbeat();
  }

  template <class Command>
  void take(const Command& m) {
    commands.push_back(m.command);
    if (!obeys) return;
    if (m.command == kDoSetMode)
      set_mode(mavlink::mode_of(mavlink::Make::kArduPilot, true,
                                static_cast<std::uint32_t>(m.param2)),
               static_cast<std::uint32_t>(m.param2));
    if (m.command == kArmDisarm) condition.armed = m.param1 > 0.5F;
    if (m.command == kNavTakeOff) condition.on_ground = false;
    if (m.command == kDoReposition) set_mode(VehicleMode::kGuided, 4);
  }
  void set_mode(VehicleMode mode, std::uint32_t to) {
    condition.mode = mode;
    number = to;
    condition.mode_name = mavlink::mode_name(mavlink::Make::kArduPilot, true, to);
  }
  void heartbeat() {
    exchange.sender.report(condition, number, exchange.now);
    exchange.sender.report_landed(condition.on_ground, exchange.now);
  }

  // Steps with a heartbeat a second; answers so far.
  std::vector<RequestAnswer> answers;
  void run(double seconds) {
    for (double t = 0; t < seconds; t += 0.1) {
      exchange.now = exchange.now + Time::from_seconds(0.1);
      if (++steps % 10 == 0) heartbeat();
      exchange.step();
      for (RequestAnswer& answer : exchange.sender.take_answers())
        answers.push_back(std::move(answer));
    }
  }
  int steps = 0;
};

std::vector<RequestStep> guided() {
  return {command(kDoSetMode, 1, 4), AwaitMode{VehicleMode::kGuided, "GUIDED"}};
}

TEST(CommandSender, WhatAHeartbeatShowsIsDone) {
  mavlink::CommandInt go;
  go.command = kDoReposition;
  const std::vector<std::vector<RequestStep>> all = {
      guided(), {command(kArmDisarm, 1)}, {command(kNavTakeOff)}, {go}};
  for (const std::vector<RequestStep>& steps : all) {
    Unacknowledged v;
    v.exchange.sender.add({7, steps});
    v.run(3);
    ASSERT_EQ(v.answers.size(), 1u);
    EXPECT_EQ(v.answers[0].outcome, Outcome::kAccepted);
    EXPECT_EQ(v.commands.size(), 1u) << "of " << v.commands[0];
  }
}

TEST(CommandSender, RepeatsWhatHadNoEffectOnceAHeartbeat) {
  Unacknowledged v;
  v.obeys = false;
  v.exchange.sender.add({7, guided()});
  v.run(10);
  ASSERT_EQ(v.answers.size(), 1u);
  EXPECT_EQ(v.answers[0].outcome, Outcome::kNoAnswer);
  EXPECT_GE(v.commands.size(), 5u);
  EXPECT_LE(v.commands.size(), 7u);
}

TEST(CommandSender, RepeatsNothingThatIsInProgress) {
  Unacknowledged v;
  v.obeys = false;
  v.exchange.sender.add({7, {command(kNavTakeOff)}});
  v.run(0.2);
  v.exchange.acknowledge(kNavTakeOff, 5);
  v.run(30);
  EXPECT_EQ(v.commands.size(), 1u);
}

// At any moment of the seconds in which it may be repeated.
TEST(CommandSender, WhoeverChoosesAnotherModeKeepsIt) {
  for (const bool obeys : {false, true})
    for (double at = 0.2; at < 5.85; at += 0.1) {
      Unacknowledged v;
      v.obeys = obeys;
      mavlink::MissionItemInt item;
      v.exchange.sender.add({7, guided()});
      v.exchange.sender.add({8, {command(kArmDisarm, 1)}});
      v.exchange.sender.add({9, {SendMission{{item}}}});
      v.run(at);
      const std::size_t sent = v.commands.size();
      v.set_mode(VehicleMode::kReturn, 6);
      v.obeys = true;
      v.run(8);
      EXPECT_EQ(v.condition.mode, VehicleMode::kReturn) << obeys << " at " << at;
      EXPECT_LE(v.commands.size(), sent + 1)
          << "of a mode or of arming, before a heartbeat";
      if (obeys) continue;  // it may have been done by then
      ASSERT_EQ(v.answers.size(), 3u) << at;
      EXPECT_EQ(v.answers[0].outcome, Outcome::kWithdrawn);
      EXPECT_EQ(v.answers[1].outcome, Outcome::kWithdrawn);
      EXPECT_EQ(
          v.answers[0].text,
          "mode GUIDED: withdrawn, since somebody else has changed its mode to RTL");
      EXPECT_NE(v.answers[2].outcome, Outcome::kWithdrawn) << "a list takes no control";
    }
}

TEST(CommandSender, WithdrawsNoEmergencyStop) {
  Unacknowledged v;
  v.condition.armed = true;
  v.obeys = false;
  v.exchange.sender.add({7, {command(kArmDisarm, 0, 21196)}});
  v.run(1);
  v.set_mode(VehicleMode::kReturn, 6);
  v.run(2);
  EXPECT_GE(v.commands.size(), 5u);
  EXPECT_TRUE(v.answers.empty());
}

// Of makes whose modes are not known.
TEST(CommandSender, ModesWithoutAMeaningWithdrawNothing) {
  Unacknowledged v;
  v.exchange.sender.set_make(mavlink::Make::kOther);
  v.obeys = false;
  v.exchange.sender.add({7, {command(kArmDisarm, 1)}});
  v.run(1);
  v.set_mode(VehicleMode::kOther, 77);
  v.run(1.5);
  EXPECT_TRUE(v.answers.empty());
}

// PX4 shows the mode of an accepted take-off when the next request is under way already.
TEST(CommandSender, AModeThatShowsLaterIsItsOwn) {
  Unacknowledged v;
  v.exchange.sender.set_make(mavlink::Make::kPx4);
  v.obeys = false;
  v.exchange.sender.add({7, {command(kNavTakeOff)}});
  v.run(0.2);
  v.exchange.acknowledge(kNavTakeOff, 0);
  v.exchange.sender.add({8, {command(kDoChangeSpeed, 0, 20)}});
  v.run(0.2);
  v.set_mode(VehicleMode::kTakeOff, 1);
  v.run(2);
  ASSERT_EQ(v.answers.size(), 1u);
  EXPECT_EQ(v.answers[0].outcome, Outcome::kAccepted);
  v.set_mode(VehicleMode::kHold, 2);  // it is up
  v.run(2);
  EXPECT_EQ(v.answers.size(), 1u);
}

}  // namespace
}  // namespace skein::autopilot_client::command_sender_test
