// SPDX-License-Identifier: Apache-2.0
#include "skein/link/autopilot_client/command_sender.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <functional>
#include <string>

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
  vehicle_services::Outbox out{245, 191, [this](auto, auto bytes) {
                                 ++sent;
                                 mavlink::FrameParser().read(
                                     bytes, [this](const mavlink::Frame& frame) {
                                       if (vehicle) vehicle(frame);
                                     });
                               }};

  // Until it is answered.
  RequestAnswer run(std::vector<RequestStep> steps, double seconds = 30) {
    sender.add({7, std::move(steps)});
    std::vector<RequestAnswer> answers;
    for (double t = 0; t < seconds && answers.empty(); t += 0.1) {
      now = now + Time::from_seconds(0.1);
      sender.step(now, 1, out);
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
  exchange.sender.set_bytewise(true);
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
  EXPECT_EQ(exchange.run(mode).text, "mode GUIDED: not answered in 12 tries");
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
  exchange.sender.report(condition);
  const RequestAnswer answer = exchange.run(mode);
  EXPECT_EQ(answer.outcome, Outcome::kDenied);
  EXPECT_EQ(answer.text, "mode GUIDED: accepted, but it stays in LOITER");
  condition.mode = VehicleMode::kGuided;
  exchange.sender.report(condition);
  EXPECT_EQ(exchange.run(mode).outcome, Outcome::kAccepted);
  EXPECT_EQ(exchange.run({command(kDoSetMode, 1, 4), AwaitArmed{}}).text,
            "arm: accepted, but it stays disarmed");
}

}  // namespace
}  // namespace skein::autopilot_client::command_sender_test
