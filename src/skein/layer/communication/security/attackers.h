// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "skein/base/random.h"
#include "skein/data/event/event.h"
#include "skein/data/radio/message.h"
#include "skein/layer/communication/medium/frame.h"
#include "skein/layer/communication/security/attack.h"

namespace skein::communication {

/// A message with all copies of it, as it was on the air.
struct AirMessage {
  std::vector<Message> copies;    ///< of a message to several one for each
  std::vector<std::byte> sealed;  ///< its wire form with its seal; empty: there are none
};

/// What attackers want sent.
struct AttackOrders {
  struct Noise {
    NodeIndex node;
    Time time, duration;
  };
  struct Packet {
    NodeIndex node;
    Time time;
    NodeIndex to;
    std::uint32_t bytes;
  };
  struct Forgery {
    NodeIndex node;
    Time time;
    AirMessage message;
  };
  std::vector<Noise> noise;
  std::vector<Packet> packets;
  std::vector<Forgery> forgeries;

  void clear() {
    noise.clear();
    packets.clear();
    forgeries.clear();
  }
};

/// What the attackers of a run do, and when. They are nodes of the medium, those after
/// the entities in the order of the list, with random numbers of their own.
///
/// A spoofer has no key: the seal of what it sends is a guess. A replayer keeps the seal
/// of what it has heard.
class Attackers {
 public:
  using Place = std::function<std::optional<Vec3>(EntityId)>;

  /// @param first   node of the first attacker
  /// @param place   where an entity is, as an attacker sees it
  /// @param sealed  messages of this run carry seals
  Attackers(std::vector<Attack> attacks, NodeIndex first, Place place, bool sealed,
            std::uint64_t seed);

  std::size_t size() const { return all_.size(); }
  const Attack& operator[](std::size_t index) const { return all_[index].attack; }

  /// Adds what they send up to `now`; events "attack-begins" and "attack-ends".
  void step(Time now, AttackOrders& orders, std::vector<Event>& events);

  /// Whether somebody records what it hears.
  bool listen() const { return listen_; }
  /// An attacker has heard a message, whoever it was for.
  void overhear(NodeIndex node, std::span<const Message> copies,
                std::span<const std::byte> sealed, Time now);

 private:
  struct Recorded {
    Time again;
    AirMessage message;
  };
  struct Attacker {
    Attack attack;
    RandomStream random;
    Time next;
    bool begun = false, ended = false;
    std::uint32_t sent = 0;                     // of a spoofer
    std::optional<std::pair<Time, Vec3>> seen;  // of a spoofer: its victim, last
    std::deque<Recorded> recorded;              // of a replayer
  };

  void announce(Attacker& attacker, Time now, std::vector<Event>& events);
  void jam(Attacker& attacker, NodeIndex node, const Jammer& jammer, Time until,
           AttackOrders& orders);
  void flood(Attacker& attacker, NodeIndex node, const Flooder& flooder, Time until,
             AttackOrders& orders);
  void spoof(Attacker& attacker, NodeIndex node, const Spoofer& spoofer, Time until,
             AttackOrders& orders);
  void replay(Attacker& attacker, NodeIndex node, Time until, AttackOrders& orders);
  std::optional<MessageContent> lie(Attacker& attacker, const Spoofer& spoofer,
                                    Time time);

  std::vector<Attacker> all_;
  NodeIndex first_;
  Place place_;
  bool sealed_, listen_ = false;
};

}  // namespace skein::communication
