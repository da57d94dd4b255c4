// SPDX-License-Identifier: Apache-2.0
#include "app/net/experiment/network_run.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

namespace skein::experiment {
namespace {

constexpr std::size_t kNoFlow = std::numeric_limits<std::size_t>::max();

communication::Links::Nodes nodes_of(const NetworkCase& network,
                                     const communication::RadioProfile& radio,
                                     communication::NodeAntennas antennas) {
  communication::Links::Nodes nodes;
  nodes.move = false;
  for (const NodeTrack& track : network.nodes) {
    nodes.transmit_power_dbm.push_back(
        track.transmit_power_dbm.value_or(radio.phy.transmit_power_dbm));
    nodes.move = nodes.move || track.moves();
  }
  nodes.place = [&network](communication::NodeIndex node, Time now) {
    return network.nodes[node].place(now);
  };
  nodes.antennas = std::move(antennas);
  return nodes;
}

const char* name_of(communication::FrameKind kind) {
  switch (kind) {
    case communication::FrameKind::kData:
      return "DATA";
    case communication::FrameKind::kAck:
      return "ACK";
    case communication::FrameKind::kRts:
      return "RTS";
    case communication::FrameKind::kCts:
      return "CTS";
  }
  return "";
}

}  // namespace

NetworkRun::NetworkRun(const NetworkCase& network,
                       const communication::RadioProfile& radio,
                       const Propagation& propagation, std::uint64_t seed,
                       communication::NodeAntennas antennas)
    : network_(network),
      medium_(radio, propagation, nodes_of(network, radio, std::move(antennas)), seed,
              *this),
      flow_order_(network.flows.size()),
      result_{{}, std::vector<NodeUse>(network.nodes.size()), {}} {
  for (communication::NodeIndex node = 0; node < network.nodes.size(); ++node)
    result_.hearers.push_back(medium_.in_range(node));
  std::iota(flow_order_.begin(), flow_order_.end(), 0);
  std::stable_sort(flow_order_.begin(), flow_order_.end(),
                   [&](std::size_t a, std::size_t b) {
                     return network_.flows[a].start < network_.flows[b].start;
                   });
  for (const TrafficItem& item : network.traffic)
    next_number_ = std::max(next_number_, item.message + 1);
}

void NetworkRun::advance(Time until) {
  until = std::min(until, network_.duration);
  while (true) {
    const bool has_item = next_traffic_ < network_.traffic.size();
    const bool has_flow = next_flow_ < flow_order_.size();
    if (!has_item && !has_flow) break;
    const Time flow_start =
        has_flow ? network_.flows[flow_order_[next_flow_]].start : until;
    const Time item_time = has_item ? network_.traffic[next_traffic_].time : until;
    const bool flow_is_next = has_flow && (!has_item || flow_start <= item_time);
    const Time next = flow_is_next ? flow_start : item_time;
    if (next >= until) break;
    medium_.advance(next);
    if (flow_is_next) {
      const std::size_t flow = flow_order_[next_flow_++];
      for (std::uint32_t i = 0; i < network_.flows[flow].depth; ++i) fill(flow);
    } else {
      const TrafficItem& item = network_.traffic[next_traffic_++];
      flow_of_.push_back(kNoFlow);
      create(item.message, item.from,
             item.to == kAllNodesOfCase ? communication::kAllNodes : item.to, item.bytes);
    }
  }
  medium_.advance(until);
}

void NetworkRun::fill(std::size_t flow) {
  const SaturatedFlow& given = network_.flows[flow];
  flow_of_.push_back(flow);
  create(next_number_++, given.from, given.to, given.bytes);
}

void NetworkRun::create(std::uint64_t number, communication::NodeIndex from,
                        communication::NodeIndex to, std::uint32_t bytes) {
  const std::uint64_t tag = result_.messages.size();
  NetworkMessage& record = result_.messages.emplace_back();
  record.number = number;
  record.from = from;
  record.to = to;
  record.bytes = bytes;
  record.sent = medium_.now();
  if (!medium_.send({from, to, bytes, tag}))
    result_.messages[tag].fate = MessageFate::kQueueFull;
}

void NetworkRun::on_frame(const communication::Frame& frame, Time now) {
  NodeUse& use = result_.nodes[frame.from];
  use.airtime += frame.duration;
  switch (frame.kind) {
    case communication::FrameKind::kData: {
      ++use.data_frames;
      NetworkMessage& record = result_.messages[frame.tag];
      ++record.transmissions;
      if (frame.to != communication::kAllNodes) break;
      record.fate = MessageFate::kDelivered;
      for (const communication::NodeIndex node : medium_.in_range(frame.from))
        record.in_range.push_back({node, std::nullopt});
      break;
    }
    case communication::FrameKind::kAck:
      ++use.ack_frames;
      break;
    case communication::FrameKind::kRts:
      ++use.rts_frames;
      ++result_.messages[frame.tag].rts;
      break;
    case communication::FrameKind::kCts:
      ++use.cts_frames;
      break;
  }
  if (on_transmission)
    on_transmission({now, frame.from, name_of(frame.kind), frame.mac_bytes});
}

void NetworkRun::on_delivered(const communication::Frame& data,
                              communication::NodeIndex receiver, Time now,
                              const communication::Reception&) {
  NetworkMessage& record = result_.messages[data.tag];
  if (data.to != communication::kAllNodes) {
    record.delivered = now;
    record.fate = MessageFate::kDelivered;
    return;
  }
  for (BroadcastReception& each : record.in_range)
    if (each.node == receiver) each.delivered = now;
}

void NetworkRun::on_finished(const communication::Packet& packet,
                             communication::PacketEnd end, Time) {
  NetworkMessage& record = result_.messages[packet.order.tag];
  if (record.fate != MessageFate::kDelivered) {
    if (end == communication::PacketEnd::kRetryLimit)
      record.fate = MessageFate::kRetryLimit;
    if (end == communication::PacketEnd::kQueueFull)
      record.fate = MessageFate::kQueueFull;
    if (end == communication::PacketEnd::kExpired) record.fate = MessageFate::kExpired;
    if (end == communication::PacketEnd::kTooLong) record.fate = MessageFate::kTooLong;
    // Not acknowledged: what is still in the air may be received.
    if (end == communication::PacketEnd::kDone) record.fate = MessageFate::kLost;
  }
  const std::size_t flow = flow_of_[packet.order.tag];
  // What is too long ends at once, and so would all that takes its place.
  if (flow != kNoFlow && end != communication::PacketEnd::kTooLong) fill(flow);
}

}  // namespace skein::experiment
