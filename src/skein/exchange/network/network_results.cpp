// SPDX-License-Identifier: Apache-2.0
#include "skein/exchange/network/network_results.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

namespace skein::exchange {
namespace {

std::string_view word_of(MessageFate fate) {
  switch (fate) {
    case MessageFate::kPending:
      return "pending";
    case MessageFate::kDelivered:
      return "delivered";
    case MessageFate::kQueueFull:
      return "queue-full";
    case MessageFate::kRetryLimit:
      return "retry-limit";
    case MessageFate::kExpired:
      return "expired";
    case MessageFate::kTooLong:
      return "too-long";
    case MessageFate::kOutOfRange:
      return "out-of-range";
    case MessageFate::kLost:
      return "lost";
  }
  return "";
}

// Seconds with nine decimals, exactly.
std::string in_seconds(Time time) {
  return fmt::format("{}.{:09}", time.ns() / 1'000'000'000, time.ns() % 1'000'000'000);
}

void count_unicast(const NetworkMessage& message, NetworkSummary& summary) {
  ++summary.sent;
  switch (message.fate) {
    case MessageFate::kDelivered:
      ++summary.delivered;
      break;
    case MessageFate::kQueueFull:
      ++summary.queue_full;
      break;
    case MessageFate::kExpired:
      ++summary.expired;
      break;
    case MessageFate::kPending:
      ++summary.pending;
      break;
    case MessageFate::kTooLong:
      ++summary.too_long;
      ++summary.given_up;
      break;
    default:
      ++summary.given_up;
  }
  if (!message.delivered) return;
  summary.delays.push_back((*message.delivered - message.sent).seconds());
}

void count_broadcast(const NetworkMessage& message, NetworkSummary& summary) {
  if (message.fate == MessageFate::kTooLong) ++summary.too_long;
  if (message.fate != MessageFate::kDelivered) return;
  ++summary.broadcasts;
  for (const BroadcastReception& each : message.in_range)
    ++(each.delivered ? summary.broadcast_receptions : summary.broadcast_losses);
}

}  // namespace

double NetworkSummary::delay_quantile(double p) const {
  if (delays.empty()) return 0;
  const auto place = static_cast<std::size_t>(p * static_cast<double>(delays.size()));
  return delays[std::min(place, delays.size() - 1)];
}

NetworkSummary summarize(const NetworkCase& network, const NetworkResult& result,
                         Time warm_up) {
  NetworkSummary summary;
  for (const NetworkMessage& message : result.messages) {
    // Of unicasts only: a broadcast has no time of delivery of its own.
    if (message.delivered && *message.delivered >= warm_up)
      summary.goodput_bps += message.bytes * 8.0;
    if (message.sent < warm_up) continue;
    if (message.to == kAllNodesOfCase)
      count_broadcast(message, summary);
    else
      count_unicast(message, summary);
  }
  const double duration = std::max(1e-9, network.duration.seconds());
  summary.goodput_bps /= std::max(1e-9, (network.duration - warm_up).seconds());
  std::sort(summary.delays.begin(), summary.delays.end());
  if (!summary.delays.empty())
    summary.mean_delay =
        std::accumulate(summary.delays.begin(), summary.delays.end(), 0.0) /
        static_cast<double>(summary.delays.size());
  if (const std::uint64_t settled = summary.sent - summary.pending; settled > 0)
    summary.loss_ratio =
        static_cast<double>(summary.queue_full + summary.given_up + summary.expired) /
        static_cast<double>(settled);
  for (const NodeUse& use : result.nodes) {
    summary.data_frames += use.data_frames;
    summary.ack_frames += use.ack_frames;
    summary.rts_frames += use.rts_frames;
    summary.cts_frames += use.cts_frames;
    summary.airtime_share += use.airtime.seconds() / duration;
  }
  return summary;
}

std::string network_summary_text(const NetworkSummary& s) {
  std::string text;
  const auto out = std::back_inserter(text);
  fmt::format_to(
      out,
      "unicast     {} sent, {} delivered, {} refused by a full queue, {} given "
      "up, {} too old, {} pending\n",
      s.sent, s.delivered, s.queue_full, s.given_up, s.expired, s.pending);
  if (s.too_long > 0)
    fmt::format_to(
        out,
        "too long    {} messages, unicast ones among those given up: no slot holds "
        "them\n",
        s.too_long);
  fmt::format_to(out, "loss        {:.3f} %\n", 100 * s.loss_ratio);
  if (s.delays.empty())
    text += "delay       -\n";
  else
    fmt::format_to(out,
                   "delay       mean {:.4f} ms, median {:.4f}, 95 % {:.4f}, 99 % {:.4f}, "
                   "longest {:.4f}\n",
                   1e3 * s.mean_delay, 1e3 * s.delay_quantile(0.5),
                   1e3 * s.delay_quantile(0.95), 1e3 * s.delay_quantile(0.99),
                   1e3 * s.delay_quantile(1));
  fmt::format_to(out, "goodput     {:.3f} kbit/s\n", s.goodput_bps / 1e3);
  fmt::format_to(out, "broadcast   {} sent, {} received, {} lost in range\n",
                 s.broadcasts, s.broadcast_receptions, s.broadcast_losses);
  fmt::format_to(out, "frames      {} DATA, {} ACK, {} RTS, {} CTS\n", s.data_frames,
                 s.ack_frames, s.rts_frames, s.cts_frames);
  fmt::format_to(out, "airtime     {:.2f} % of the time, summed over all nodes\n",
                 100 * s.airtime_share);
  return text;
}

std::string network_messages_csv(const NetworkCase& network,
                                 const NetworkResult& result) {
  std::string text = "message,from,to,sent_s,delivered_s,outcome,transmissions,rts\n";
  const auto out = std::back_inserter(text);
  const auto row = [&](const NetworkMessage& message, std::uint32_t to,
                       const std::optional<Time>& delivered, MessageFate fate) {
    fmt::format_to(out, "{},{},{},{},{},{},{},{}\n", message.number,
                   network.names[message.from], network.names[to],
                   in_seconds(message.sent), delivered ? in_seconds(*delivered) : "",
                   word_of(fate), message.transmissions, message.rts);
  };
  std::vector<const BroadcastReception*> by_node(network.nodes.size());
  for (const NetworkMessage& message : result.messages) {
    if (message.to != kAllNodesOfCase) {
      row(message, message.to, message.delivered, message.fate);
      continue;
    }
    std::fill(by_node.begin(), by_node.end(), nullptr);
    for (const BroadcastReception& each : message.in_range) by_node[each.node] = &each;
    for (std::uint32_t node = 0; node < network.nodes.size(); ++node) {
      if (node == message.from) continue;
      MessageFate fate = message.fate;
      std::optional<Time> delivered;
      if (fate == MessageFate::kDelivered) {
        if (by_node[node]) delivered = by_node[node]->delivered;
        if (!delivered)
          fate = by_node[node] ? MessageFate::kLost : MessageFate::kOutOfRange;
      }
      row(message, node, delivered, fate);
    }
  }
  return text;
}

std::string network_trace_header() {
  return "start_us,node,frame,mac_bytes\n";
}

std::string network_trace_row(const NetworkCase& network,
                              const TransmissionRecord& transmission) {
  const std::int64_t ns = transmission.start.ns();
  return fmt::format("{}.{:03},{},{},{}\n", ns / 1000, ns % 1000,
                     network.names[transmission.from], transmission.kind,
                     transmission.mac_bytes);
}

}  // namespace skein::exchange
