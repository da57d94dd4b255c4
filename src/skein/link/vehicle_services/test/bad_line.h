// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <random>
#include <utility>
#include <vector>

#include "skein/base/time.h"
#include "skein/link/mavlink/frame_parser.h"
#include "skein/link/mavlink/messages.h"
#include "skein/link/mavlink/payload.h"
#include "skein/link/vehicle_services/outbox.h"

namespace skein::vehicle_services {

/// What a line does to frames.
struct Trouble {
  double loss = 0;        ///< probability of each to be lost
  double delay = 0;       ///< [s]
  double jitter = 0;      ///< up to so much more [s]: frames overtake each other
  double duplicates = 0;  ///< probability of each to come twice
};

/// A line between a vehicle (7/1) and a ground station (255/190), in simulated time.
class BadLine {
 public:
  using Receiver = std::function<void(const mavlink::Frame&)>;

  /// Both ends sign over secured channels.
  BadLine(const Trouble& trouble, unsigned seed,
          mavlink::LinkSecurity* of_vehicle = nullptr,
          mavlink::LinkSecurity* of_station = nullptr)
      : vehicle(
            7, 1, [this](Channel, auto bytes) { send(to_station_, bytes); }, of_vehicle),
        station(
            255, 190, [this](Channel, auto bytes) { send(to_vehicle_, bytes); },
            of_station),
        trouble_(trouble),
        random_(seed) {}

  /// From now on; what is under way comes as it would have.
  void set_trouble(const Trouble& trouble) { trouble_ = trouble; }

  Outbox vehicle, station;
  Receiver at_vehicle, at_station;
  Time now;

  /// One more hundredth of a second.
  void step() {
    now = now + Time::from_seconds(0.01);
    deliver(to_vehicle_, at_vehicle);
    deliver(to_station_, at_station);
  }

 private:
  using Waiting = std::multimap<Time, std::vector<std::byte>>;

  bool chance(double probability) {
    return std::uniform_real_distribution<double>()(random_) < probability;
  }
  void send(Waiting& to, std::span<const std::byte> bytes) {
    if (chance(trouble_.loss)) return;
    for (int k = chance(trouble_.duplicates) ? 2 : 1; k > 0; --k) {
      const double delay =
          trouble_.delay +
          trouble_.jitter * std::uniform_real_distribution<double>()(random_);
      to.emplace(now + Time::from_seconds(delay),
                 std::vector<std::byte>(bytes.begin(), bytes.end()));
    }
  }
  void deliver(Waiting& waiting, const Receiver& receiver) {
    while (!waiting.empty() && waiting.begin()->first <= now) {
      const std::vector<std::byte> bytes = std::move(waiting.begin()->second);
      waiting.erase(waiting.begin());
      mavlink::FrameParser().read(bytes, receiver);
    }
  }

  Trouble trouble_;
  std::mt19937 random_;
  Waiting to_vehicle_, to_station_;
};

/// Calls handle(message) when the frame is a T.
template <class T, class Handle>
void on(const mavlink::Frame& frame, Handle&& handle) {
  if (frame.message && frame.id() == mavlink::kFacts<T>.id)
    handle(mavlink::unpack<T>(frame.payload()));
}

inline Peer peer_of(const mavlink::Frame& frame) {
  return {1, frame.system(), frame.component()};
}

/// What links do to frames, from good to hardly usable.
inline std::vector<Trouble> troubles() {
  return {{}, {0.05, 0.02, 0.05, 0.05}, {0.3, 0.1, 0.2, 0.2}, {0.3, 0.5, 0.1, 0}};
}

}  // namespace skein::vehicle_services
