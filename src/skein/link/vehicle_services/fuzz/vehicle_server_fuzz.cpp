// SPDX-License-Identifier: Apache-2.0
// A simulated vehicle, whatever ground stations send and whatever the simulation says: it
// neither fails nor grows, all that it sends are frames over links that are there, and
// what it asks of the simulation can be flown.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <variant>

#include "skein/link/mavlink/dispatch.h"
#include "skein/link/mavlink/fuzz/message_feed.h"
#include "skein/link/mavlink/messages.h"
#include "skein/link/vehicle_services/request_queue.h"
#include "skein/link/vehicle_services/vehicle_server.h"

namespace {

using namespace skein;
using namespace skein::vehicle_services;
using mavlink::Frame;
using Feed = mavlink::MessageFeed<
    mavlink::CommandLong, mavlink::CommandInt, mavlink::SetMode, mavlink::MissionCount,
    mavlink::MissionItemInt, mavlink::MissionItem, mavlink::MissionRequestList,
    mavlink::MissionRequestInt, mavlink::MissionRequest, mavlink::MissionClearAll,
    mavlink::MissionSetCurrent, mavlink::MissionWritePartialList,
    mavlink::ParamRequestList, mavlink::ParamRequestRead, mavlink::ParamSet,
    mavlink::RequestDataStream, mavlink::RcChannelsOverride, mavlink::ManualControl,
    mavlink::SetAttitudeTarget, mavlink::SetPositionTargetGlobalInt,
    mavlink::SetPositionTargetLocalNed, mavlink::Timesync, mavlink::Ping,
    mavlink::FileTransferProtocol, mavlink::LogRequestList, mavlink::LogRequestData>;

constexpr int kMaxBurst = 1000;    // frames of one call
constexpr double kMaxPlace = 2e6;  // of what is asked for [m]

VehicleServerOptions options_of(std::uint8_t byte) {
  VehicleServerOptions options;
  options.system = 7;
  options.make = (byte & 1) != 0 ? Make::kPx4 : Make::kArduPilot;
  options.hovers = (byte & 2) != 0;
  if (options.hovers) options.limits.slowest = 0;
  options.home_can_be_set = (byte & 4) != 0;
  return options;
}

// What the simulation says next: of `code` the low bits are what, the rest how much.
void change(VehicleSnapshot& snapshot, std::uint32_t code) {
  const double amount = (code >> 8) % 2048 - 1024.0;
  switch (code % 11) {
    case 0:
      snapshot.condition.armed = !snapshot.condition.armed;
      break;
    case 1:
      snapshot.condition.on_ground = !snapshot.condition.on_ground;
      break;
    case 2:
      snapshot.condition.position = !snapshot.condition.position;
      break;
    case 3:
      snapshot.condition.mode = static_cast<VehicleMode>((code >> 8) % 9);
      break;
    case 4:
      snapshot.progress = {static_cast<std::uint16_t>((code >> 8) % 8),
                           (code >> 16) % 2 != 0};
      break;
    case 5:
      snapshot.paused = !snapshot.paused;
      break;
    case 6:
      snapshot.not_ready = snapshot.not_ready.empty() ? "no reason" : "";
      break;
    case 7:
      snapshot.motion.v_N = {amount, -amount, amount / 8};
      snapshot.motion.wind_N = {amount / 32, amount};
      break;
    case 8:
      snapshot.condition.charge = amount / 1024;
      snapshot.condition.voltage = amount;
      snapshot.condition.emergency = amount < -1000;
      break;
    case 9:
      snapshot.home_N.z() = -amount;
      break;
    default:
      snapshot.motion.p_N += Vec3(amount, 2 * amount, -amount);
  }
}

bool is_place(const Vec3& p) {
  return p.norm() < kMaxPlace;
}

// Whether the simulation can do something with a request.
struct Flyable {
  bool operator()(const TakeOffRequest& r) const {
    return std::abs(r.altitude_msl) < kMaxPlace &&
           (!r.course || std::isfinite(*r.course));
  }
  bool operator()(const LandRequest& r) const {
    return std::abs(r.ground_msl) < kMaxPlace &&
           (!r.point || r.point->norm() < kMaxPlace) &&
           (!r.course || std::isfinite(*r.course));
  }
  bool operator()(const FlyToRequest& r) const {
    return is_place(r.p_N) && r.radius >= 0 && std::isfinite(r.radius) &&
           (!r.airspeed || *r.airspeed > 0);
  }
  bool operator()(const BankSetpoint& r) const {
    return std::abs(r.roll) <= geo::kPi && std::abs(r.altitude_msl) < kMaxPlace &&
           std::abs(r.climb_rate) < 100 && r.airspeed > 0 && r.airspeed < 100;
  }
  bool operator()(const TrackSetpoint& r) const {
    return is_place(r.p_N) && r.v_N.norm() < 1e4 && r.a_N.norm() < 1e4 &&
           (!r.heading || std::isfinite(*r.heading));
  }
  bool operator()(const SpeedRequest& r) const {
    return r.airspeed > 0 && r.airspeed < 100;
  }
  bool operator()(const MissionUpload& r) const {
    for (const MissionItem& item : r.items)
      if (!is_place(item.p_N) || !(item.hold >= 0) || !std::isfinite(item.hold) ||
          (item.kind == MissionItem::Kind::kJump && item.to >= r.items.size()))
        return false;
    return true;
  }
  bool operator()(const PilotRequest& r) const {
    return std::abs(r.input.roll) <= 1 && std::abs(r.input.pitch) <= 1 &&
           std::abs(r.input.yaw) <= 1 && std::abs(r.input.throttle) <= 1;
  }
  template <class Other>
  bool operator()(const Other&) const {
    return true;
  }
};

struct Subject {
  explicit Subject(Feed& from) : feed(from) {
    snapshot.home_N = snapshot.motion.p_N = {100, 200, -400};
    snapshot.ground_msl = 400;
  }

  Clocks clocks() const { return {feed.now(), Time::from_ns(feed.now().ns() * pace)}; }

  void open(Channel channel) { server.open(channel, clocks()); }
  void close(Channel channel) {
    server.close(channel);
    out.close(channel);
  }

  void receive(const Frame& frame, Channel channel, Time) {
    sent = 0;
    server.receive(frame, channel, clocks(), out);
    // A message that no vehicle takes says what the simulation does.
    if (frame.message && frame.id() == mavlink::kFacts<mavlink::LogRequestData>.id)
      mavlink::dispatch<mavlink::LogRequestData>(
          frame, [&](const auto& m) { simulate(m.ofs ^ m.count); });
  }

  void step(Time now) {
    simulate(static_cast<std::uint32_t>(now.ns() / 1'000'000));
    sent = 0;
    server.step(clocks(), out);
    const auto requests = server.take_requests();
    SKEIN_CHECK(requests.size() <= RequestQueue::kMaxWaiting);
    for (const VehicleRequest& request : requests) {
      SKEIN_CHECK(std::visit(Flyable(), request), request.index());
      if (const auto* arm = std::get_if<ArmRequest>(&request))
        snapshot.condition.armed = arm->arm;
      if (const auto* mode = std::get_if<ModeRequest>(&request))
        snapshot.condition.mode = mode->mode;
    }
    if (const auto home = server.take_home()) {
      SKEIN_CHECK(is_place(*home));
      snapshot.home_N = *home;
    }
  }

  void simulate(std::uint32_t code) {
    change(snapshot, code);
    snapshot.motion.time = clocks().simulated;
    server.update(snapshot);
  }

  void check_sent(Channel channel, std::span<const std::byte> bytes) {
    SKEIN_CHECK(++sent <= kMaxBurst);
    SKEIN_CHECK(feed.is_open(channel), channel);
    mavlink::take_sent(bytes, [&](const Frame& frame) {
      SKEIN_CHECK(frame.system() == 7 && frame.component() == 1);
      mavlink::dispatch<mavlink::MissionRequestInt>(frame, [&](const auto& m) {
        mavlink::MissionItemInt item;
        item.seq = m.seq;
        item.mission_type = m.mission_type;
        item.target_system = 7;
        item.frame = 6;
        item.command = m.mission_type == 0 ? 16 : m.mission_type == 1 ? 5004 : 5100;
        item.param1 = 50;
        item.x = 470'000'000;
        item.y = 80'000'000;
        item.z = 50;
        feed.expect(item, channel, m.target_system, m.target_component);
      });
    });
  }

  Feed& feed;
  std::uint8_t option = feed.option();
  int pace = option / 8;  // of the run's clock
  VehicleSnapshot snapshot;
  VehicleServer server{options_of(option), geo::LocalFrame::at({47, 8, 0}).value()};
  Outbox out{7, 1, [this](Channel to, auto bytes) { check_sent(to, bytes); }};
  int sent = 0;  // by the last call
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Feed feed({data, size}, 7, 1);
  Subject subject(feed);
  feed.run(subject);
  return 0;
}
