// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "skein/layer/communication/medium/access.h"
#include "skein/layer/communication/medium/channel.h"
#include "skein/layer/communication/medium/medium_listener.h"
#include "skein/layer/communication/medium/packet.h"

namespace skein::communication {

/// A radio medium between nodes: who hears what, and when.
///
/// Event driven, in integer nanoseconds; what happens does not depend on how often
/// advance() is called. The random numbers of a node are its own.
class Medium {
 public:
  /// @param propagation, listener  outlive this
  Medium(const RadioProfile& profile, const Propagation& propagation, Links::Nodes nodes,
         std::uint64_t seed, MediumListener& listener);

  Medium(const Medium&) = delete;
  Medium& operator=(const Medium&) = delete;

  Time now() const { return now_; }

  /// Nodes that do not move by themselves are elsewhere from now on.
  void places_changed() { links_.renew(); }

  /// Does everything that happens before `until`, which is then now.
  void advance(Time until);

  /// A packet is handed to the radio of `order.from` now. In a full queue it takes the
  /// place of a less urgent one, if there is any.
  /// @returns false when the queue is full; nothing more is heard of it then
  bool send(const PacketOrder& order);

  /// The same at a later time; a queue that is full then is heard of as kQueueFull.
  void send_at(Time time, const PacketOrder& order);

  /// A node sends noise, whatever it hears: nobody can decode it, all sense it.
  /// @param duration  above 0, at most 4 s
  void send_noise_at(Time time, NodeIndex node, Time duration);

  /// Packets that wait or are in service.
  std::size_t waiting() const { return packets_.size(); }

  /// Those of one node.
  std::size_t waiting(NodeIndex node) { return access_->queue(node).size(); }

  /// How long signals have been on their way at most.
  Time longest_delay() const { return links_.longest_delay(); }

  /// How long a node has heard that others send. Of lines that share nothing: 0.
  Time heard(NodeIndex node) const { return channel_.heard(node, now_); }

  /// Whether `to` would decode a frame of `from` that began now, without interference.
  bool reaches(NodeIndex from, NodeIndex to);
  /// Who would decode a frame of `from` that began now, without interference.
  std::vector<NodeIndex> in_range(NodeIndex from);

 private:
  void hand_over(std::uint32_t place);
  void expect_expiry(NodeIndex node);
  void drop_expired(NodeIndex node);

  const RadioProfile profile_;
  Time now_;
  Schedule schedule_;
  PacketStore packets_;
  Links links_;
  std::vector<PacketOrder> orders_;  // for later, by small numbers
  std::vector<std::uint32_t> free_orders_;
  std::vector<bool> expiry_expected_;  // by node
  std::vector<std::uint32_t> expired_;
  std::unique_ptr<Access> access_;
  Channel channel_;
  MediumListener& listener_;
};

}  // namespace skein::communication
