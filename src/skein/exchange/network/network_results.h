// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "skein/data/radio/network_case.h"
#include "skein/data/radio/network_result.h"

namespace skein::exchange {

/// Figures of a network's messages.
///
/// Unicasts count by themselves: lost are those that were refused, given up or too old
/// without having been received; of broadcasts counts who received them.
struct NetworkSummary {
  std::uint64_t sent = 0;  ///< unicasts
  std::uint64_t delivered = 0, queue_full = 0, given_up = 0, expired = 0, pending = 0;
  std::uint64_t too_long = 0;    ///< never sent: unicasts given up so, and broadcasts
  double loss_ratio = 0;         ///< of those that are not pending
  double goodput_bps = 0;        ///< payload of unicasts received
  std::vector<double> delays;    ///< from creation to first reception [s], rising
  double mean_delay = 0;         ///< [s]
  std::uint64_t broadcasts = 0;  ///< on the air
  std::uint64_t broadcast_receptions = 0, broadcast_losses = 0;  ///< of those in range
  std::uint64_t data_frames = 0, ack_frames = 0, rts_frames = 0, cts_frames = 0;
  double airtime_share = 0;  ///< sum over all nodes, of the duration

  /// Element floor(p n) of the sorted delays, counted from 0 [s]; 0 when there is none.
  double delay_quantile(double p) const;
};

/// @param warm_up  messages created before it do not count, and goodput is that of what
///   is received from then on; frames and airtime are those of the whole case
NetworkSummary summarize(const NetworkCase& network, const NetworkResult& result,
                         Time warm_up = Time());

/// The summary as lines for people.
std::string network_summary_text(const NetworkSummary& summary);

/// What became of each message as CSV with columns message, from, to, sent_s,
/// delivered_s, outcome, transmissions, rts: a row for each message and receiver; a
/// broadcast has one for every other node. Seconds have nine decimals. In order of
/// creation, receivers of a broadcast in their order.
std::string network_messages_csv(const NetworkCase& network, const NetworkResult& result);

/// `start_us,node,frame,mac_bytes` and a row of it, microseconds with three decimals.
std::string network_trace_header();
std::string network_trace_row(const NetworkCase& network,
                              const TransmissionRecord& transmission);

/// A page with the summary, the distribution of delays, goodput over time, who hears whom
/// as a map and a matrix, and each node's airtime. Needs no network.
std::string network_page(const std::string& title, const NetworkCase& network,
                         const NetworkResult& result);

}  // namespace skein::exchange
