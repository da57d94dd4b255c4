// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "skein/link/world_link/session.h"

namespace skein::world_link {

/// What a line does to packets.
struct Trouble {
  double loss = 0;        ///< probability of each to be lost
  double delay = 0;       ///< [s]
  double jitter = 0;      ///< up to so much more [s]: packets overtake each other
  double duplicates = 0;  ///< probability of each to come twice
};

/// What lines do to packets, from good to hardly usable.
inline std::vector<Trouble> troubles() {
  return {{}, {0.05, 0.02, 0.05, 0.05}, {0.3, 0.1, 0.2, 0.2}, {0.3, 0.4, 0.1, 0}};
}

/// One end: a session, and what came.
struct End {
  End(SessionOptions options, Time clock) : session(std::move(options)), ahead(clock) {}

  void post(const std::string& text, Time now) {
    session.post(bytes_of(text), now + ahead);
  }
  void show(const std::string& text) { session.show(bytes_of(text)); }
  void take(const Packet& packet, Time now) {
    session.receive(packet, now + ahead, [&](const Delivery& delivery) {
      came.emplace_back(delivery.coded.begin(), delivery.coded.end());
      shift = delivery.shift;
    });
    for (SessionChange& change : session.take_changes()) changes.push_back(change.kind);
  }
  static std::vector<std::byte> bytes_of(const std::string& text) {
    const auto bytes = std::as_bytes(std::span(text));
    return {bytes.begin(), bytes.end()};
  }

  Session session;
  Time ahead;  // what its clock shows more than the test's
  std::vector<std::string> came;
  std::vector<SessionChange::Kind> changes;
  Time shift;
};

/// Two ends and the line between them, in simulated time.
class PacketLine {
 public:
  PacketLine(const Trouble& trouble, unsigned seed) : trouble_(trouble), random_(seed) {}

  Time now;
  bool cut = false;  ///< nothing goes either way

  /// One more hundredth of a second; an end that is null is not there.
  void step(End* a, End* b) {
    now = now + Time::from_seconds(0.01);
    deliver(to_a_, a);
    deliver(to_b_, b);
    run(a, to_b_);
    run(b, to_a_);
  }
  void run_for(double seconds, End* a, End* b) {
    for (int k = 0; k < 100 * seconds; ++k) step(a, b);
  }

 private:
  using Waiting = std::multimap<Time, std::vector<std::byte>>;

  bool chance(double probability) {
    return std::uniform_real_distribution<double>()(random_) < probability;
  }
  void run(End* end, Waiting& to) {
    if (!end) return;
    end->session.step(now + end->ahead, [&](const Packet& packet) { send(packet, to); });
    for (SessionChange& change : end->session.take_changes())
      end->changes.push_back(change.kind);
  }
  void send(const Packet& packet, Waiting& to) {
    if (cut || chance(trouble_.loss)) return;
    std::vector<std::byte> bytes;
    encode(packet, bytes);
    for (int k = chance(trouble_.duplicates) ? 2 : 1; k > 0; --k) {
      const double delay =
          trouble_.delay +
          trouble_.jitter * std::uniform_real_distribution<double>()(random_);
      to.emplace(now + Time::from_seconds(delay), bytes);
    }
  }
  void deliver(Waiting& waiting, End* end) {
    while (!waiting.empty() && waiting.begin()->first <= now) {
      const std::vector<std::byte> bytes = std::move(waiting.begin()->second);
      waiting.erase(waiting.begin());
      if (end) end->take(decode_packet(bytes).value(), now);
    }
  }

  Trouble trouble_;
  std::mt19937 random_;
  Waiting to_a_, to_b_;
};

}  // namespace skein::world_link
