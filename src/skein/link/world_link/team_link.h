// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "skein/base/id.h"
#include "skein/base/time.h"
#include "skein/data/describe/describe.h"
#include "skein/data/radio/message.h"
#include "skein/link/autopilot_client/clock_alignment.h"

namespace skein::world_link {

/// What agents of a team send to all others directly.
struct TeamPacket {
  std::uint32_t protocol = 0x314D4B53;  ///< "SKM1"
  std::uint64_t session = 0;            ///< of the sender, from the time of its start
  EntityId from;
  std::uint64_t number = 0;        ///< counts the session's packets, from 1
  Time sent;                       ///< by the sender's clock, as are times in the message
  std::optional<Message> message;  ///< none: it is there, nothing more
};

constexpr auto describe(const TeamPacket*) {
  using T = TeamPacket;
  return described<T>({"team_packet"}, "What agents of a team send to each other.",
                      field("protocol", &T::protocol, "the same in all packets"),
                      field("session", &T::session, "of the sender"),
                      field("from_id", &T::from, "who sent it"),
                      field("number", &T::number, "counts the session's packets"),
                      field("sent", &T::sent, "by the sender's clock"),
                      field("message", &T::message, "none: it is there, nothing more"));
}

/// The direct link between the agents of a team, by radio or network: everybody sends to
/// all, what is lost is lost, and what comes twice is taken once. Without input or output
/// of its own.
///
/// Clocks are aligned by the fastest packet: times that come are late by the time that
/// this one took.
class TeamLink {
 public:
  using Send = std::function<void(std::span<const std::byte>)>;

  TeamLink(EntityId self, std::uint64_t session) : self_(self), session_(session) {}

  /// @param message  times are of this end's clock.
  void send(const Message& message, Time now, const Send& send);

  /// Says that it is there, once a second.
  void step(Time now, const Send& send);

  /// Something came; appends the messages in it that are for this agent.
  void receive(std::span<const std::byte> bytes, Time now, std::vector<Message>& out);

  /// Whether the agent of another entity was heard in the last three seconds.
  bool hears(EntityId other, Time now) const;

 private:
  struct Peer {
    std::uint64_t session = 0, newest = 0, before = 0;  // bit k: newest - 1 - k came
    Time heard;
    autopilot_client::ClockAlignment alignment;
  };

  void send(std::optional<Message> message, Time now, const Send& send);
  static bool is_new(Peer& peer, std::uint64_t number);

  EntityId self_;
  std::uint64_t session_, packets_ = 0;
  std::optional<Time> last_sent_;
  std::map<EntityId, Peer> peers_;
};

}  // namespace skein::world_link
