// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "skein/data/radio/network_case.h"
#include "skein/data/radio/network_result.h"
#include "skein/layer/communication/medium/medium.h"

namespace skein::experiment {

/// The messages of a case on a medium of their own: who got what, and when.
class NetworkRun final : private communication::MediumListener {
 public:
  /// @param network, propagation  outlive this
  /// @param antennas  of the nodes
  NetworkRun(const NetworkCase& network, const communication::RadioProfile& radio,
             const Propagation& propagation, std::uint64_t seed,
             communication::NodeAntennas antennas = {});

  /// Called at the start of every frame.
  std::function<void(const TransmissionRecord&)> on_transmission;

  /// Goes on to `until`, at most the end of the case.
  void advance(Time until);
  bool done() const { return medium_.now() >= network_.duration; }
  Time now() const { return medium_.now(); }

  /// What has become of all messages until now.
  const NetworkResult& result() const { return result_; }

 private:
  void on_frame(const communication::Frame& frame, Time now) override;
  void on_delivered(const communication::Frame& data, communication::NodeIndex receiver,
                    Time now, const communication::Reception& reception) override;
  void on_finished(const communication::Packet& packet, communication::PacketEnd end,
                   Time now) override;

  void create(std::uint64_t number, communication::NodeIndex from,
              communication::NodeIndex to, std::uint32_t bytes);
  void fill(std::size_t flow);

  const NetworkCase& network_;
  communication::Medium medium_;
  std::size_t next_traffic_ = 0, next_flow_ = 0;
  std::vector<std::size_t> flow_order_;  // by their start
  std::uint64_t next_number_ = 0;        // of messages of flows
  NetworkResult result_;                 // a packet's tag is the place of its message
  std::vector<std::size_t> flow_of_;     // of each message; kNoFlow: of the traffic
};

}  // namespace skein::experiment
