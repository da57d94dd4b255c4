// SPDX-License-Identifier: Apache-2.0
// A recorded exchange with ArduPlane 4.5.7: what it said when it was taken off.
#include <gtest/gtest.h>

#include <charconv>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "skein/link/autopilot_client/autopilot_client.h"
#include "skein/link/mavlink/frame_parser.h"
#include "skein/link/mavlink/payload.h"

namespace skein::autopilot_client::arduplane_exchange_test {
namespace {

constexpr Channel kLine = 1;
using Bytes = std::vector<std::byte>;

Bytes bytes_of(const std::string& hex) {
  Bytes bytes;
  for (std::size_t k = 0; k + 1 < hex.size(); k += 2) {
    unsigned value = 0;
    std::from_chars(hex.data() + k, hex.data() + k + 2, value, 16);
    bytes.push_back(static_cast<std::byte>(value));
  }
  return bytes;
}

// Plays the vehicle's side: its telemetry at the times that it had, its answers when they
// are asked for.
class Recorded {
 public:
  Recorded() {
    std::ifstream file(SKEIN_SOURCE_DIR
                       "/src/skein/link/autopilot_client/test/arduplane_4_5_7.txt");
    std::string line;
    while (std::getline(file, line)) {
      std::istringstream words(line);
      std::string time, hex;
      words >> time >> hex;
      if (time.empty() || time == "#") continue;
      if (time != "answer")
        telemetry_.emplace_back(Time::from_seconds(std::stod(time)), bytes_of(hex));
      else
        keep_answer(bytes_of(hex));
    }
  }

  void step(Time now) {
    while (next_ < telemetry_.size() && telemetry_[next_].first <= now)
      deliver(telemetry_[next_++].second, now);
    for (const Bytes& bytes : std::exchange(asked_, {})) answer(bytes, now);
    client.step(now, out_);
    for (VehicleReport& report : client.take_reports())
      reports.push_back(std::move(report));
  }
  void take_off(double altitude_msl, Time now) {
    client.request(7, TakeOffRequest{altitude_msl, {}}, now, out_);
  }

  AutopilotClient client = make();
  std::vector<VehicleReport> reports;
  std::size_t frames() const { return telemetry_.size(); }

 private:
  static AutopilotClient make() {
    AutopilotClientOptions options;
    options.start.emplace();
    AutopilotClient made(options, geo::LocalFrame::at({36.989, -122.0514, 0}).value());
    made.open(kLine);
    return made;
  }
  void deliver(const Bytes& bytes, Time now) {
    mavlink::FrameParser().read(bytes, [&](const mavlink::Frame& frame) {
      client.receive(frame, kLine, now, out_);
    });
  }
  void keep_answer(const Bytes& bytes) {
    mavlink::FrameParser().read(bytes, [&](const mavlink::Frame& frame) {
      if (frame.id() == mavlink::kFacts<mavlink::CommandAck>.id)
        answers_[mavlink::unpack<mavlink::CommandAck>(frame.payload()).command] = bytes;
      else
        parameter_ = bytes;
    });
  }
  void answer(const Bytes& bytes, Time now) {
    mavlink::FrameParser().read(bytes, [&](const mavlink::Frame& frame) {
      if (frame.id() == mavlink::kFacts<mavlink::ParamSet>.id)
        return deliver(parameter_, now);
      if (frame.id() != mavlink::kFacts<mavlink::CommandLong>.id) return;
      const auto asked = mavlink::unpack<mavlink::CommandLong>(frame.payload()).command;
      const auto recorded = answers_.find(asked);
      if (recorded != answers_.end()) return deliver(recorded->second, now);
      mavlink::CommandAck ack;  // of rates and messages: accepted, as all were
      ack.command = asked;
      vehicle_services::Outbox vehicle(1, 1, [&](auto, std::span<const std::byte> sent) {
        deliver(Bytes(sent.begin(), sent.end()), now);
      });
      vehicle.send(kLine, ack);
    });
  }

  std::vector<std::pair<Time, Bytes>> telemetry_;
  std::size_t next_ = 0;
  std::map<std::uint16_t, Bytes> answers_;
  Bytes parameter_;
  std::vector<Bytes> asked_;
  Outbox out_{245, 191, [this](auto, std::span<const std::byte> bytes) {
                asked_.emplace_back(bytes.begin(), bytes.end());
              }};
};

// It keeps its parameter of the altitude as an integer: asked for 119.9 m it says 119.
TEST(ArduPlaneExchange, ATakeOffToAFractionOfAMetreIsAccepted) {
  Recorded vehicle;
  ASSERT_GT(vehicle.frames(), 100u);
  const Time asked = Time::from_seconds(11.9);
  for (int k = 0; k < 850; ++k) {
    const Time now = Time::from_seconds(0.02 * k);
    vehicle.step(now);
    if (now == asked) vehicle.take_off(119.9, now);
  }
  std::vector<RequestAnswer> answers;
  std::string make;
  for (const VehicleReport& report : vehicle.reports) {
    if (const auto* answer = std::get_if<RequestAnswer>(&report))
      answers.push_back(*answer);
    if (const auto* identity = std::get_if<VehicleIdentity>(&report))
      make = identity->make;
  }
  ASSERT_EQ(answers.size(), 1u);
  EXPECT_EQ(answers[0].number, 7u);
  EXPECT_EQ(answers[0].outcome, RequestAnswer::Outcome::kAccepted) << answers[0].text;
  EXPECT_EQ(make, "ArduPilot 4.5.7");
}

}  // namespace
}  // namespace skein::autopilot_client::arduplane_exchange_test
