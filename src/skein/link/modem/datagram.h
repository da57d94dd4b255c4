// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <variant>
#include <vector>

#include "skein/base/id.h"
#include "skein/base/result.h"
#include "skein/base/time.h"
#include "skein/data/describe/describe.h"
#include "skein/data/radio/message.h"

// What goes over a radio modem. Times are of the origin's clock.

namespace skein::modem {

/// Where somebody is reached.
struct Address {
  std::uint32_t hw = 0;  ///< the modem
  std::uint32_t sw = 0;  ///< the identity: EntityId

  bool operator==(const Address&) const = default;
};

constexpr auto describe(const Address*) {
  using T = Address;
  return described<T>({"address"}, "Where somebody is reached.",
                      field("hw", &T::hw, "the modem; 4294967295: all"),
                      field("sw", &T::sw, "the identity; 4294967295: all"));
}

/// Of either part of an address: whoever hears it.
inline constexpr std::uint32_t kAll = 0xFFFFFFFFu;

/// Who is reached through a modem.
struct Advertisement {
  std::uint32_t scenario = 0;  ///< fingerprint of what all must have in common
  std::vector<std::uint32_t> identities;
};

constexpr auto describe(const Advertisement*) {
  using T = Advertisement;
  return described<T>(
      {"advertisement"}, "Who is reached through a modem.",
      field("scenario", &T::scenario, "fingerprint of what all have in common"),
      field("identities", &T::identities, Storage::kJson, "of these entities"));
}

/// A message, once for all of its receivers.
struct Carried {
  Message message;
  std::vector<std::uint32_t> receivers;  ///< empty: whom the address names
};

constexpr auto describe(const Carried*) {
  using T = Carried;
  return described<T>(
      {"carried"}, "A message.", field("message", &T::message, "as its sender wrote it"),
      field("receivers", &T::receivers, Storage::kJson, "empty: whom the address names"));
}

/// New kinds go to the end: the place in this list is part of the wire form.
using Payload = std::variant<Advertisement, Carried>;

inline constexpr std::uint32_t kProtocol = 0x32444B53;  // "SKD2"

/// What a modem sends at once.
struct Datagram {
  std::uint32_t protocol = kProtocol;
  std::uint64_t session = 0;  ///< of the origin's program; grows from one to its next
  Address origin;             ///< who made it
  Address to;
  std::uint64_t number = 0;  ///< counts those of the origin's modem in a session, from 1
  Urgency urgency = Urgency::kReport;
  Time sent;  ///< when it was handed to the modem
  Payload payload;
};

constexpr auto describe(const Datagram*) {
  using T = Datagram;
  return described<T>(
      {"datagram"}, "What a modem sends at once.",
      field("protocol", &T::protocol, "the same in all datagrams of this version"),
      field("session", &T::session, "of the origin's program"),
      field("", &T::origin, "who made it"),
      field("to", &T::to, Storage::kJson, "for whom"),
      field("number", &T::number, "counts those of the origin's modem"),
      field("urgency", &T::urgency, "more urgent ones go first"),
      field("sent", &T::sent, "when it was handed to the modem"),
      field("payload", &T::payload, Storage::kJson, "what it brings"));
}

/// Largest datagram [bytes], its seal included. UDP carries twice that; a serial line of
/// 57,600 baud is busy with it for 5.6 s.
inline constexpr std::size_t kMaxDatagram = 32'000;

/// Appends a datagram in its wire form.
void encode(const Datagram& datagram, std::vector<std::byte>& out);

/// Fails: kBadInput for bytes that are no datagram of this version, or whose numbers make
///        no sense.
Result<Datagram> decode_datagram(std::span<const std::byte> bytes);

}  // namespace skein::modem
