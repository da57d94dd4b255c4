// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "skein/layer/communication/medium/frame.h"

namespace skein::communication {

/// What somebody wants sent.
struct PacketOrder {
  NodeIndex from = 0;
  NodeIndex to = kAllNodes;
  std::uint32_t bytes = 0;   ///< of payload
  std::uint64_t tag = 0;     ///< the caller's own number for it
  std::uint8_t urgency = 0;  ///< more urgent ones are sent first
};

/// An order that waits or is in service.
struct Packet {
  PacketOrder order;
  Time created;
  std::uint32_t transmissions = 0;  ///< of its data frame
  std::uint32_t rts_sent = 0;
  bool delivered = false;  ///< of a unicast: to its receiver, at least once
};

/// Packets by small numbers, which are used again.
class PacketStore {
 public:
  std::uint32_t add(const PacketOrder& order, Time now) {
    std::uint32_t place = 0;
    if (free_.empty()) {
      place = static_cast<std::uint32_t>(packets_.size());
      packets_.emplace_back();
    } else {
      place = free_.back();
      free_.pop_back();
    }
    packets_[place] = {order, now, 0, 0, false};
    return place;
  }
  void remove(std::uint32_t place) { free_.push_back(place); }
  Packet& operator[](std::uint32_t place) { return packets_[place]; }
  std::size_t size() const { return packets_.size() - free_.size(); }

 private:
  std::vector<Packet> packets_;
  std::vector<std::uint32_t> free_;
};

}  // namespace skein::communication
