// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "skein/base/id.h"
#include "skein/base/time.h"
#include "skein/data/describe/describe.h"
#include "skein/data/radio/message.h"

namespace skein {

/// Why a message never arrived.
enum class LossCause : std::uint8_t {
  kNone,         ///< it has arrived
  kChance,       ///< by the loss that the scenario gives the radio
  kOutage,       ///< one of the two modems was out
  kOutOfRange,   ///< too weak at its receiver
  kQueueFull,    ///< the sender's radio had no room for it
  kRetryLimit,   ///< given up after as many transmissions as the radio may try
  kExpired,      ///< too old before it was sent
  kNotReceived,  ///< sent once, strong enough, and not understood
  kLinkDown,     ///< the sender or the receiver does not reach its radio
  kNobody,       ///< its receiver takes no part
  kRefused,      ///< its receiver found that it was not authentic
  kPending,      ///< not lost: still on its way when the run ended
};
constexpr auto names_of(const LossCause*) {
  return std::to_array<std::string_view>(
      {"none", "chance", "outage", "out-of-range", "queue-full", "retry-limit", "expired",
       "not-received", "link-down", "nobody", "refused", "pending"});
}

/// How a message went over the air.
struct MessageWay {
  std::optional<Time> on_air;       ///< its first frame began; none: never, or not known
  std::uint32_t transmissions = 0;  ///< data frames, of all its parts
  std::uint32_t hops = 0;           ///< radios that passed it on
};

constexpr auto describe(const MessageWay*) {
  using T = MessageWay;
  return described<T>(
      {"message_way"}, "How a message went over the air.",
      field("on_air", &T::on_air,
            "when its first frame began; null: never, or not known"),
      field("transmissions", &T::transmissions, "data frames, of all its parts"),
      field("hops", &T::hops, "radios that passed it on"));
}

/// A message that has arrived or is lost.
struct MessageOutcome {
  Message message;
  LossCause cause = LossCause::kNone;
  MessageWay way = {};
};

/// What a modem knows about the air around it.
struct RadioStatus {
  /// Share of the last second in which the medium was busy, by others or by itself; where
  /// each sends in times of its own, the share of these that it used. 0 to 1.
  double load = 0;
  std::uint32_t waiting = 0;  ///< packets that it has not sent yet
  bool shared = false;        ///< others use the same medium
};

/// What a radio did since the last of these.
struct RadioUse {
  std::uint32_t frames = 0;   ///< sent: data, answers, announcements
  double sending_share = 0;   ///< of the time
  double busy_share = 0;      ///< of the time: others were heard, or heard to be there
  std::uint32_t waiting = 0;  ///< messages in its queue, the most at once
  std::uint32_t queue_full = 0, retry_limit = 0, expired = 0;  ///< packets lost so
  std::uint32_t received = 0;                                  ///< packets for it

  /// Share of the time in which it sent or heard others.
  double load() const { return std::min(1.0, sending_share + busy_share); }
};

constexpr auto describe(const RadioUse*) {
  using T = RadioUse;
  return described<T>(
      {"radio_use"}, "What a radio did in a while.",
      field("frames", &T::frames, "sent: data, answers, announcements"),
      field("sending_share", &T::sending_share, "of the time"),
      field("busy_share", &T::busy_share, "of the time: others were heard"),
      field("waiting", &T::waiting, "packets in its queue, the most at once"),
      field("queue_full", &T::queue_full, "packets that the queue had no room for"),
      field("retry_limit", &T::retry_limit, "packets given up"),
      field("expired", &T::expired, "packets too old before they were sent"),
      field("received", &T::received, "packets that arrived for it"));
}

/// How well one radio hears another.
struct LinkUse {
  EntityId from, to;
  std::uint32_t arrived = 0, lost = 0;  ///< messages
  std::optional<double> rssi_dbm;       ///< mean of what arrived
  std::optional<double> sinr_db;        ///< mean of the least of each frame
  std::optional<double> delay;          ///< mean from sending to arrival [s]
};

constexpr auto describe(const LinkUse*) {
  using T = LinkUse;
  return described<T>(
      {"link_use"}, "How well one radio heard another in a while.",
      field("from_id", &T::from, "who sent"), field("to_id", &T::to, "for whom"),
      field("arrived", &T::arrived, "messages"), field("lost", &T::lost, "messages"),
      field("rssi_dbm", &T::rssi_dbm, "mean level of what was received"),
      field("sinr_db", &T::sinr_db,
            "mean ratio of signal to noise and interference, the least of each frame"),
      field("delay", &T::delay, unit::kSecond, "mean from sending to arrival"));
}

}  // namespace skein
