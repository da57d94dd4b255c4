// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "skein/layer/communication/medium/access.h"
#include "skein/layer/communication/medium/medium_listener.h"
#include "skein/layer/communication/medium/packet.h"

namespace skein::communication {

/// Each node sends in a slot of its own, in turn; nothing is acknowledged.
///
/// Slot k of a frame of as many slots as there are members belongs to node k, from the
/// beginning of time; outsiders send in slots of members. A node sends what waits and
/// fits into what is left of its slot, the oldest first; a packet that no slot holds ends
/// as too long, without a transmission. Clocks agree.
class Tdma final : public Access {
 public:
  /// All outlive this; the channel is the one that this listens to.
  Tdma(const RadioProfile& profile, std::size_t nodes, std::size_t members,
       Schedule& schedule, PacketStore& packets, MediumListener& listener);
  void use(Channel& channel) override { channel_ = &channel; }

  PacketQueue& queue(NodeIndex node) override { return stations_[node].queue; }
  void enqueue(std::uint32_t packet, Time now) override;
  void handle(const Schedule::Event& event) override;

  void on_busy(NodeIndex, Time, Time) override {}
  void on_payload(NodeIndex, Time, Time) override {}
  void on_payload_lost(NodeIndex, Time) override {}
  void on_received(NodeIndex node, Time now, const Frame& frame,
                   const Reception& reception) override;

 private:
  struct Station {
    PacketQueue queue;
    bool awake = false;  // a slot is awaited or used
  };

  Time airtime(std::uint32_t bytes) const;
  Time next_slot(NodeIndex node, Time now) const;
  void use_slot(NodeIndex node, Time now);
  void finish(NodeIndex node, PacketEnd end, Time now);

  const MacProfile& mac_;
  const PhyProfile& phy_;
  Schedule& schedule_;
  PacketStore& packets_;
  MediumListener& listener_;
  Channel* channel_ = nullptr;
  std::int64_t slots_;  // of a frame
  std::vector<Station> stations_;
};

}  // namespace skein::communication
