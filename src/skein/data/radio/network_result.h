// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "skein/base/time.h"
#include "skein/data/radio/network_case.h"

namespace skein {

/// What became of a message.
enum class MessageFate : std::uint8_t {
  kPending,     ///< waits or is in service at the end
  kDelivered,   ///< received at least once
  kQueueFull,   ///< refused at creation
  kRetryLimit,  ///< a unicast that was given up and never received
  kExpired,     ///< too old before it was sent
  kTooLong,     ///< no slot of the radio holds it: never sent
  kOutOfRange,  ///< of a broadcast: too weak at this receiver
  /// Of a broadcast: strong enough and not received. Of a unicast that nobody
  /// acknowledges: not received.
  kLost,
};

/// A receiver in range of a broadcast.
struct BroadcastReception {
  std::uint32_t node = 0;
  std::optional<Time> delivered;
};

struct NetworkMessage {
  std::uint64_t number = 0;
  std::uint32_t from = 0, to = 0;  ///< to: or kAllNodesOfCase
  std::uint32_t bytes = 0;
  Time sent;                                 ///< handed to the radio
  std::optional<Time> delivered;             ///< of a unicast: its first reception
  MessageFate fate = MessageFate::kPending;  ///< of a broadcast: kDelivered when sent
  std::uint32_t transmissions = 0, rts = 0;
  /// Of a broadcast that was sent: those that its signal reached well enough.
  std::vector<BroadcastReception> in_range;
};

/// What a node put on the air.
struct NodeUse {
  std::uint64_t data_frames = 0, ack_frames = 0, rts_frames = 0, cts_frames = 0;
  Time airtime;
};

/// A frame that begins.
struct TransmissionRecord {
  Time start;
  std::uint32_t from = 0;
  const char* kind = "";  ///< DATA, ACK, RTS or CTS
  std::uint32_t mac_bytes = 0;
};

/// What has become of a case.
struct NetworkResult {
  std::vector<NetworkMessage> messages;  ///< in order of creation
  std::vector<NodeUse> nodes;
  /// Who would hear whom at the beginning, without interference: of each node those that
  /// decode it.
  std::vector<std::vector<std::uint32_t>> hearers;
};

}  // namespace skein
