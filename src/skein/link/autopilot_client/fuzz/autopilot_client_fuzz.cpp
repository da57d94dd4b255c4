// SPDX-License-Identifier: Apache-2.0
// The near end of a link to a vehicle, whatever comes by it and whatever is asked of the
// vehicle: it neither fails nor grows, all that it sends are frames for the vehicle over
// links that are there, each request is answered once at most, and motions are numbers.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <set>
#include <span>
#include <variant>
#include <vector>

#include "skein/base/valid_text.h"
#include "skein/link/autopilot_client/autopilot_client.h"
#include "skein/link/mavlink/dispatch.h"
#include "skein/link/mavlink/fuzz/message_feed.h"
#include "skein/link/mavlink/messages.h"

namespace {

using namespace skein;
using namespace skein::autopilot_client;
using mavlink::Frame;
using Feed = mavlink::MessageFeed<
    mavlink::Heartbeat, mavlink::GlobalPositionInt, mavlink::Attitude, mavlink::VfrHud,
    mavlink::Wind, mavlink::WindCov, mavlink::GpsRawInt, mavlink::SysStatus,
    mavlink::ExtendedSysState, mavlink::HomePosition, mavlink::SystemTime,
    mavlink::Timesync, mavlink::AutopilotVersion, mavlink::Statustext,
    mavlink::CommandAck, mavlink::ParamValue, mavlink::MissionRequest,
    mavlink::MissionRequestInt, mavlink::MissionAck, mavlink::MissionCurrent,
    mavlink::LogRequestData>;

constexpr std::uint8_t kVehicle = 7, kHere = 245;
constexpr int kMaxBurst = 1000;            // frames of one call
constexpr std::size_t kMaxReports = 1000;  // of one step
constexpr std::size_t kMaxText = 2000;

AutopilotClientOptions options_of(std::uint8_t byte) {
  AutopilotClientOptions options;
  options.system = kVehicle;
  options.hovers = (byte & 1) != 0;
  options.rate = 1 + (byte >> 1) % 50;
  return options;
}

MissionUpload mission(std::uint32_t code) {
  MissionUpload upload;
  for (std::uint32_t k = 0; k < code % 8; ++k) {
    MissionItem item;
    item.kind = static_cast<MissionItem::Kind>((code >> 3) % 5);
    item.p_N = {100.0 * k, 50, -100};
    upload.items.push_back(item);
  }
  return upload;
}

FenceUpload fence(std::uint32_t code) {
  FenceUpload upload;
  for (std::uint32_t k = 0; k < code % 4; ++k) {
    Zone zone;
    zone.name = "zone";
    zone.area = geo::Ring{{0, 0}, {100.0 + k, 0}, {100, 100}};
    upload.zones.push_back(zone);
  }
  return upload;
}

// Of `code` the low bits are what, the rest how much.
VehicleRequest request_of(std::uint32_t code) {
  const double amount = (code >> 8) % 2048 - 1024.0;
  switch (code % 14) {
    case 0:
      return ModeRequest{static_cast<VehicleMode>((code >> 8) % 9)};
    case 1:
      return ArmRequest{(code & 256) != 0, (code & 512) != 0};
    case 2:
      return TakeOffRequest{amount, amount / 300};
    case 3:
      return LandRequest{Vec2(amount, -amount), 0, amount / 300};
    case 4:
      return FlyToRequest{{amount, amount, -100}, 20, amount};
    case 5:
      return BankSetpoint{amount / 1024, amount, amount / 100, 20};
    case 6:
      return TrackSetpoint{{amount, 0, -amount}, {1, 2, 3}, {0, amount, 0}, amount};
    case 7:
      return SpeedRequest{std::abs(amount)};
    case 8:
      return mission(code >> 8);
    case 9:
      return MissionStart{static_cast<std::uint16_t>(code >> 8)};
    case 10:
      return PilotRequest{};
    case 11: {
      ObstacleDistances obstacles;
      obstacles.range = std::abs(amount) + 1;
      obstacles.distances.fill(amount);
      return obstacles;
    }
    case 12:
      return fence(code >> 8);
    default:
      return PositionFix{{amount, amount, -amount}, {amount, 0, 1}};
  }
}

struct Subject {
  explicit Subject(Feed& from) : feed(from) {}

  void open(Channel channel) { client.open(channel); }
  void close(Channel channel) {
    client.close(channel);
    out.close(channel);
  }

  // Most senders are the vehicle; one is somebody else with another number.
  void receive(const Frame& frame, Channel channel, Time now) {
    std::vector<std::byte> bytes(frame.bytes.begin(), frame.bytes.end());
    if (frame.system() != 254) {
      bytes[5] = std::byte{kVehicle};
      bytes[6] = std::byte{1};
    }
    sent = 0;
    client.receive(Frame{bytes, frame.message}, channel, now, out);
    if (frame.message && frame.id() == mavlink::kFacts<mavlink::LogRequestData>.id)
      mavlink::dispatch<mavlink::LogRequestData>(
          frame, [&](const auto& m) { ask(m.ofs ^ m.count, now); });
  }

  void ask(std::uint32_t code, Time now) {
    sent = 0;
    waiting.insert(++number);
    client.request(number, request_of(code), now, out);
  }

  void step(Time now) {
    ask(static_cast<std::uint32_t>(now.ns() / 1'000'000), now);
    sent = 0;
    client.step(now, out);
    const std::vector<VehicleReport> reports = client.take_reports();
    SKEIN_CHECK(reports.size() <= kMaxReports, reports.size());
    for (const VehicleReport& report : reports) check(report);
  }

  void check(const VehicleReport& report) {
    if (const auto* answer = std::get_if<RequestAnswer>(&report))
      SKEIN_CHECK(waiting.erase(answer->number) == 1, answer->number);
    if (const auto* motion = std::get_if<VehicleMotion>(&report)) {
      SKEIN_CHECK(motion->p_N.allFinite() && motion->v_N.allFinite());
      SKEIN_CHECK(motion->q_NB.coeffs().allFinite() && motion->w_NB_B.allFinite());
      SKEIN_CHECK(motion->wind_N.allFinite());
    }
    if (const auto* text = std::get_if<VehicleText>(&report)) {
      SKEIN_CHECK(text->text.size() <= kMaxText);
      SKEIN_CHECK(is_valid_text(text->text));
    }
  }

  void check_sent(Channel channel, std::span<const std::byte> bytes) {
    SKEIN_CHECK(++sent <= kMaxBurst);
    SKEIN_CHECK(feed.is_open(channel), channel);
    mavlink::take_sent(bytes, [&](const Frame& frame) {
      SKEIN_CHECK(frame.system() == kHere);
      const std::uint8_t target = frame.target_system();
      SKEIN_CHECK(target == 0 || target == kVehicle, int{target});
      mavlink::dispatch<mavlink::CommandLong, mavlink::CommandInt, mavlink::MissionCount,
                        mavlink::MissionItemInt>(
          frame, [&](const auto& m) { expect_answer(m, channel); });
    });
  }

  template <class Sent>
  void expect_answer(const Sent& m, Channel channel) {
    if constexpr (requires {
                    m.command;
                    m.confirmation;
                  }) {
      mavlink::CommandAck ack;
      ack.command = m.command;
      ack.target_system = kHere;
      feed.expect(ack, channel, kVehicle, 1);
    } else if constexpr (requires {
                           m.count;
                           m.mission_type;
                         }) {
      mavlink::MissionRequestInt next;
      next.mission_type = m.mission_type;
      next.target_system = kHere;
      feed.expect(next, channel, kVehicle, 1);
    } else if constexpr (requires {
                           m.seq;
                           m.mission_type;
                         }) {
      mavlink::MissionRequestInt next;
      next.seq = static_cast<std::uint16_t>(m.seq + 1);
      next.mission_type = m.mission_type;
      next.target_system = kHere;
      feed.expect(next, channel, kVehicle, 1);
    }
  }

  Feed& feed;
  AutopilotClient client{options_of(feed.option()),
                         geo::LocalFrame::at({47, 8, 0}).value()};
  Outbox out{kHere, 191, [this](Channel to, auto bytes) { check_sent(to, bytes); }};
  std::uint32_t number = 0;         // of the last request
  std::set<std::uint32_t> waiting;  // requests without an answer
  int sent = 0;                     // by the last call
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Feed feed({data, size}, kHere, 191);
  Subject subject(feed);
  feed.run(subject);
  return 0;
}
