// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "skein/base/random.h"
#include "skein/layer/communication/medium/access.h"
#include "skein/layer/communication/medium/links.h"
#include "skein/layer/communication/medium/medium_listener.h"
#include "skein/layer/communication/medium/packet.h"

namespace skein::communication {

/// Each node has a line of its own, as by satellite or cell: no medium to share.
///
/// Packets of a node go one after the other at the rate of the profile and arrive
/// `latency` after their last bit left, unless `loss` takes them. A receiver is reached
/// where its signal would be decoded. Nothing is acknowledged or interferes.
class DirectAccess final : public Access {
 public:
  /// All but the seed outlive this.
  DirectAccess(const RadioProfile& profile, Links& links, Schedule& schedule,
               PacketStore& packets, MediumListener& listener, std::uint64_t seed);

  void use(Channel&) override {}  // it has none

  PacketQueue& queue(NodeIndex node) override { return stations_[node].queue; }
  void enqueue(std::uint32_t packet, Time now) override;
  void handle(const Schedule::Event& event) override;

  void on_busy(NodeIndex, Time, Time) override {}
  void on_payload(NodeIndex, Time, Time) override {}
  void on_payload_lost(NodeIndex, Time) override {}
  void on_received(NodeIndex, Time, const Frame&, const Reception&) override {}

 private:
  struct Station {
    PacketQueue queue;             // the first one is being sent
    std::deque<Frame> on_the_way;  // sent and not yet arrived
  };

  void begin(NodeIndex node, Time now);
  void arrive(NodeIndex node, Time now);

  const MacProfile& mac_;
  const PhyProfile& phy_;
  double decode_threshold_, noise_;  // [W]
  Links& links_;
  Schedule& schedule_;
  PacketStore& packets_;
  MediumListener& listener_;
  std::vector<Station> stations_;
  std::vector<RandomStream> losses_;
};

}  // namespace skein::communication
