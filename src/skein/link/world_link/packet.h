// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "skein/base/result.h"
#include "skein/base/time.h"
#include "skein/data/describe/describe.h"

// What a world and an agent in another program send each other. Times are of the
// sender's clock, which runs evenly from its start.

namespace skein::world_link {

/// Who speaks.
struct Hello {
  std::string software;  ///< name and version, for people
  std::string entity;    ///< that the agent is; empty: the world
  std::string scenario;  ///< fingerprint of what both must have in common
};

constexpr auto describe(const Hello*) {
  using T = Hello;
  return described<T>(
      {"hello"}, "Who speaks.", field("software", &T::software, "name and version"),
      field("entity", &T::entity, "that the agent is; empty: the world"),
      field("scenario", &T::scenario, "fingerprint of what both have in common"));
}

/// The end of a session.
struct Bye {
  bool refused = false;  ///< there was none
  std::string why;
};

constexpr auto describe(const Bye*) {
  using T = Bye;
  return described<T>({"bye"}, "The end of a session.",
                      field("refused", &T::refused, "there was none"),
                      field("why", &T::why, "for people"));
}

/// When the newest packet of the other side was sent, and how long ago it came.
struct Echo {
  Time sent;  ///< of the other side's clock
  Time held;  ///< since it came
};

constexpr auto describe(const Echo*) {
  using T = Echo;
  return described<T>({"echo"}, "The newest packet that came from the other side.",
                      field("sent", &T::sent, "by the other side's clock"),
                      field("held", &T::held, "since it came"));
}

/// A value that is sent until it is acknowledged.
struct Parcel {
  std::uint64_t number = 0;  ///< counts the session's, from 1
  std::vector<std::uint8_t> coded;
};

constexpr auto describe(const Parcel*) {
  using T = Parcel;
  return described<T>({"parcel"}, "A value that is sent until it is acknowledged.",
                      field("number", &T::number, "counts the session's, from 1"),
                      field("coded", &T::coded, Storage::kBytes, "in its wire form"));
}

inline constexpr std::uint32_t kProtocol = 0x314C4B53;  // "SKL1"

/// What is sent at once: a datagram, or a frame of a connection.
struct Packet {
  std::uint32_t protocol = kProtocol;
  std::uint64_t session = 0;        ///< of the sender; grows from one to its next
  std::uint64_t heard_session = 0;  ///< of the receiver, as the sender knows it; 0: none
  std::uint64_t number = 0;         ///< counts the session's packets, from 1
  Time sent;
  std::optional<Echo> echo;
  std::uint64_t oldest = 1;        ///< no older parcel comes any more
  std::uint64_t acknowledged = 1;  ///< all parcels before it have come
  std::uint64_t ahead = 0;         ///< bit k: so has number acknowledged + 1 + k
  std::vector<Parcel> parcels;
  std::vector<std::vector<std::uint8_t>> newest;  ///< coded values that are sent once
  std::optional<Hello> hello;
  std::optional<Bye> bye;
};

constexpr auto describe(const Packet*) {
  using T = Packet;
  return described<T>(
      {"packet"}, "What is sent at once.",
      field("protocol", &T::protocol, "the same in all packets"),
      field("session", &T::session, "of the sender"),
      field("heard_session", &T::heard_session, "of the receiver, as known; 0: none"),
      field("number", &T::number, "counts the session's packets"),
      field("sent", &T::sent, "by the sender's clock"),
      field("echo", &T::echo, "of the newest packet that came"),
      field("oldest", &T::oldest, "no older parcel comes any more"),
      field("acknowledged", &T::acknowledged, "all parcels before it have come"),
      field("ahead", &T::ahead, "bit k: so has number acknowledged + 1 + k"),
      field("parcels", &T::parcels, Storage::kJson, "sent until acknowledged"),
      field("newest", &T::newest, Storage::kJson, "sent once"),
      field("hello", &T::hello, "until the other side has heard it"),
      field("bye", &T::bye, "at the end"));
}

/// Largest value that is sent, coded [bytes]: a datagram holds it.
inline constexpr std::size_t kMaxValue = 60'000;

/// Appends a packet in its wire form.
void encode(const Packet& packet, std::vector<std::byte>& out);

/// Fails: kBadInput for bytes that are no packet.
Result<Packet> decode_packet(std::span<const std::byte> bytes);

}  // namespace skein::world_link
