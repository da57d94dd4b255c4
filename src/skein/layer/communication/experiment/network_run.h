#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "skein/data/network_case.h"
#include "skein/data/network_result.h"
#include "skein/layer/communication/medium/medium.h"

namespace skein::communication {

/// The messages of a case on a medium of their own: who got what, and when.
class NetworkRun final : private MediumListener {
 public:
  /// @param network, propagation  outlive this
  /// @param antennas  of the nodes
  NetworkRun(const NetworkCase& network, const RadioProfile& radio,
             const Propagation& propagation, std::uint64_t seed,
             NodeAntennas antennas = {});

  /// Called at the start of every frame.
  std::function<void(const TransmissionRecord&)> on_transmission;

  /// Goes on to `until`, at most the end of the case.
  void advance(Time until);
  bool done() const { return medium_.now() >= network_.duration; }
  Time now() const { return medium_.now(); }

  /// What has become of all messages until now.
  const NetworkResult& result() const { return result_; }

 private:
  void on_frame(const Frame& frame, Time now) override;
  void on_delivered(const Frame& data, NodeIndex receiver, Time now,
                    const Reception& reception) override;
  void on_finished(const Packet& packet, PacketEnd end, Time now) override;

  void create(std::uint64_t number, NodeIndex from, NodeIndex to, std::uint32_t bytes);
  void fill(std::size_t flow);

  const NetworkCase& network_;
  Medium medium_;
  std::size_t next_traffic_ = 0, next_flow_ = 0;
  std::vector<std::size_t> flow_order_;  // by their start
  std::uint64_t next_number_ = 0;        // of messages of flows
  NetworkResult result_;                 // a packet's tag is the place of its message
  std::vector<std::size_t> flow_of_;     // of each message; kNoFlow: of the traffic
};

}  // namespace skein::communication
