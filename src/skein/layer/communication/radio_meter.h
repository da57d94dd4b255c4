// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "skein/data/radio/radio.h"
#include "skein/layer/communication/medium/frame.h"
#include "skein/layer/communication/medium/medium_listener.h"
#include "skein/layer/communication/medium/radio_profile.h"
#include "skein/role/radio.h"

namespace skein::communication {

/// Keeps what radios and links are used for.
class RadioMeter {
 public:
  RadioMeter(AccessMethod access, std::size_t nodes);

  void frame(const Frame& frame);
  void queue(NodeIndex node, std::size_t waiting);
  void lost(NodeIndex node, PacketEnd end);
  void received(const Frame& data, NodeIndex node, const Reception& reception);
  void message_arrived(EntityId from, EntityId to, Time delay);
  void message_lost(EntityId from, EntityId to);

  /// To be called at each step. `heard`: how long a node has heard others.
  void step(Time now, const std::function<Time(NodeIndex)>& heard);

  /// Share of the last second in which a node could not have sent, or did.
  double load(NodeIndex node) const { return nodes_[node].load; }
  /// What happened since the last call, up to the last step.
  RadioStatistics take();

 private:
  static constexpr std::size_t kMarks = 11;
  struct Mark {
    Time sending, heard;
  };
  struct Node {
    RadioUse use;
    Time sending, heard;                  // since the beginning
    Time taken_sending, taken_heard;      // of that, already told
    std::array<Mark, kMarks> marks = {};  // of the last steps, a tenth of a second apart
    double load = 0;
  };
  struct LinkSums {
    NodeIndex to;
    std::uint32_t arrived = 0, lost = 0, frames = 0;
    double rssi_dbm = 0, sinr_db = 0, delay = 0;
  };

  LinkSums& link(NodeIndex from, NodeIndex to);

  AccessMethod access_;
  std::vector<Node> nodes_;
  std::vector<std::vector<LinkSums>> links_;  // by sender; in the order of receivers
  Time now_, taken_;
  std::array<Time, kMarks> mark_times_ = {};
  std::size_t marks_ = 0;  // how many were made
};

}  // namespace skein::communication
