// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "skein/layer/communication/medium/packet.h"

namespace skein::communication {

/// How the service of a packet ends.
enum class PacketEnd : std::uint8_t {
  kDone,        ///< acknowledged; of a broadcast: sent
  kRetryLimit,  ///< given up
  kExpired,     ///< too old before it was sent
  kQueueFull,   ///< dropped for a more urgent one
  kTooLong,     ///< no slot holds it
};

/// Who hears what becomes of packets.
class MediumListener {
 public:
  virtual ~MediumListener() = default;

  /// A frame begins.
  virtual void on_frame(const Frame& frame, Time now) = 0;
  /// A data frame has reached `receiver`: its broadcasts, and of unicasts the first
  /// transmission that comes through.
  virtual void on_delivered(const Frame& data, NodeIndex receiver, Time now,
                            const Reception& reception) = 0;
  /// A data frame for another has reached `receiver` too; retransmissions as well.
  virtual void on_overheard(const Frame&, NodeIndex /*receiver*/, Time /*now*/) {}
  /// The medium has done with a packet. The one that takes its place may be ordered now.
  virtual void on_finished(const Packet& packet, PacketEnd end, Time now) = 0;
};

}  // namespace skein::communication
