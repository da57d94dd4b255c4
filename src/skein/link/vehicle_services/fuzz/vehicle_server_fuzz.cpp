// Any messages in any order, clocks that jump, links that come and go, a simulation that
// says anything: a vehicle neither fails nor grows, and all that it sends are frames, over
// links that are open.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <set>
#include <span>
#include <tuple>
#include <vector>

#include "skein/base/check.h"
#include "skein/link/mavlink/frame_parser.h"
#include "skein/link/mavlink/frame_writer.h"
#include "skein/link/mavlink/messages.h"
#include "skein/link/vehicle_services/request_queue.h"
#include "skein/link/vehicle_services/vehicle_server.h"

namespace {

using namespace skein;
using namespace skein::vehicle_services;

// Reads the input from its begin on; zeros after its end.
class Input {
 public:
  explicit Input(std::span<const std::byte> bytes) : left_(bytes) {}
  bool empty() const { return left_.empty(); }
  template <class T>
  T take() {
    T value{};
    const std::size_t size = std::min(sizeof value, left_.size());
    std::memcpy(&value, left_.data(), size);
    left_ = left_.subspan(size);
    return value;
  }
  std::span<const std::byte> take_bytes(std::size_t size) {
    const auto bytes = left_.first(std::min(size, left_.size()));
    left_ = left_.subspan(bytes.size());
    return bytes;
  }

 private:
  std::span<const std::byte> left_;
};

// What a vehicle does with most of its time.
using Concerning = std::tuple<
    mavlink::CommandLong, mavlink::CommandInt, mavlink::SetMode, mavlink::MissionCount,
    mavlink::MissionItemInt, mavlink::MissionItem, mavlink::MissionRequestList,
    mavlink::MissionRequestInt, mavlink::MissionRequest, mavlink::MissionClearAll,
    mavlink::MissionSetCurrent, mavlink::MissionWritePartialList,
    mavlink::ParamRequestList, mavlink::ParamRequestRead, mavlink::ParamSet,
    mavlink::RequestDataStream, mavlink::RcChannelsOverride, mavlink::ManualControl,
    mavlink::SetAttitudeTarget, mavlink::SetPositionTargetGlobalInt,
    mavlink::SetPositionTargetLocalNed, mavlink::Timesync, mavlink::Ping,
    mavlink::FileTransferProtocol, mavlink::LogRequestList, mavlink::LogRequestData>;

constexpr Channel kChannels = 4;

class World {
 public:
  explicit World(std::uint8_t identity)
      : server_(options(identity), geo::LocalFrame::at({47, 8, 0}).value()),
        out_(7, 1, [this](Channel channel, std::span<const std::byte> bytes) {
          take_frame(channel, bytes);
        }) {}

  void act(Input& input) {
    frames_ = 0;
    switch (input.take<std::uint8_t>() % 12) {
      case 0:
        now_.wall = Time::from_ns(input.take<std::int32_t>() * 10'000LL);
        break;
      case 1:
        now_.simulated = Time::from_ns(input.take<std::int32_t>() * 10'000LL);
        break;
      case 2:
        open(input.take<std::uint8_t>() % kChannels);
        break;
      case 3:
        close(input.take<std::uint8_t>() % kChannels);
        break;
      case 4:
        server_.update(snapshot(input));
        break;
      case 5:
        step();
        break;
      case 6:
        SKEIN_CHECK(server_.take_requests().size() <= RequestQueue::kMaxWaiting);
        break;
      case 7:
        receive_bytes(input.take_bytes(64));
        break;
      default:
        receive(input, static_cast<const Concerning*>(nullptr));
    }
  }

 private:
  static VehicleServerOptions options(std::uint8_t identity) {
    VehicleServerOptions options;
    options.system = 7;
    options.make = (identity & 1) != 0 ? Make::kPx4 : Make::kArduPilot;
    options.hovers = (identity & 2) != 0;
    return options;
  }

  static VehicleSnapshot snapshot(Input& input) {
    VehicleSnapshot snapshot;
    const auto bits = input.take<std::uint8_t>();
    snapshot.condition.armed = (bits & 1) != 0;
    snapshot.condition.on_ground = (bits & 2) != 0;
    snapshot.condition.position = (bits & 4) != 0;
    snapshot.condition.emergency = (bits & 8) != 0;
    snapshot.paused = (bits & 16) != 0;
    if ((bits & 32) != 0) snapshot.not_ready = "no reason";
    snapshot.condition.mode = static_cast<VehicleMode>(input.take<std::uint8_t>() % 9);
    snapshot.progress.current = input.take<std::uint8_t>();
    snapshot.progress.finished = (bits & 64) != 0;
    const auto coordinate = [&] { return input.take<std::int16_t>() * 1.0; };
    snapshot.motion.p_N = {coordinate(), coordinate(), coordinate()};
    snapshot.motion.v_N = {coordinate(), coordinate(), coordinate()};
    snapshot.motion.wind_N = {coordinate(), coordinate()};
    snapshot.condition.voltage = coordinate();
    snapshot.condition.charge = coordinate();
    snapshot.home_N = {0, 0, -400};
    return snapshot;
  }

  void open(Channel channel) {
    open_.insert(channel);
    server_.open(channel, now_);
  }
  void close(Channel channel) {
    open_.erase(channel);
    server_.close(channel);
    out_.close(channel);
  }

  void step() { server_.step(now_, out_); }

  void take_frame(Channel channel, std::span<const std::byte> bytes) {
    SKEIN_CHECK(open_.contains(channel));
    // Texts, a list of modes, telemetry: no input makes a burst of more.
    SKEIN_CHECK(++frames_ <= 1000);
    int whole = 0;
    mavlink::FrameParser parser;
    parser.read(bytes, [&](const mavlink::Frame& frame) {
      SKEIN_CHECK(frame.message && frame.system() == 7 && frame.component() == 1);
      SKEIN_CHECK(frame.bytes.size() == bytes.size());
      ++whole;
    });
    SKEIN_CHECK(whole == 1);
  }

  void receive_bytes(std::span<const std::byte> bytes) {
    mavlink::FrameParser().read(bytes, [&](const mavlink::Frame& frame) {
      server_.receive(frame, 0, now_, out_);
    });
  }

  template <class... Ts>
  void receive(Input& input, const std::tuple<Ts...>*) {
    const std::size_t kind = input.take<std::uint8_t>() % sizeof...(Ts);
    const auto channel = static_cast<Channel>(input.take<std::uint8_t>() % kChannels);
    std::size_t at = 0;
    ((at++ == kind ? receive_one<Ts>(input, channel) : void()), ...);
  }

  template <class T>
  void receive_one(Input& input, Channel channel) {
    const auto who = input.take<std::uint8_t>();
    T message = mavlink::unpack<T>(input.take_bytes(mavlink::kLength<T>));
    if constexpr (requires { message.target_system; }) message.target_system %= 8;
    if constexpr (requires { message.target_component; }) message.target_component %= 2;
    if constexpr (requires { message.mission_type; }) message.mission_type %= 4;
    mavlink::FrameWriter writer(static_cast<std::uint8_t>(255 - who % 2), 190);
    mavlink::FrameParser().read(writer.write(message), [&](const mavlink::Frame& frame) {
      server_.receive(frame, channel, now_, out_);
    });
  }

  Clocks now_;
  std::set<Channel> open_;
  VehicleServer server_;
  Outbox out_;
  int frames_ = 0;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  Input input({reinterpret_cast<const std::byte*>(data), size});
  World world(input.take<std::uint8_t>());
  while (!input.empty()) world.act(input);
  return 0;
}
