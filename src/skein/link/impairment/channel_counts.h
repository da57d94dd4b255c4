// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "skein/base/time.h"

namespace skein::impairment {

/// What has passed one direction, and what became of the rest. Of a stream a packet is a
/// piece of it, cut anyhow.
struct ChannelCounts {
  std::uint64_t packets_in = 0, bytes_in = 0;
  std::uint64_t packets_out = 0, bytes_out = 0;  ///< copies too
  std::uint64_t lost_by_chance = 0;
  std::uint64_t lost_queue_full = 0;  ///< or too much was under way
  std::uint64_t lost_in_outage = 0;
  std::uint64_t duplicated = 0;
  std::uint64_t reordered = 0;  ///< that arrived behind one that was sent later
  Time delay_sum, delay_max;    ///< from coming in to going out, of packets_out

  /// [s]; 0 when nothing went out.
  double delay_mean() const {
    return packets_out == 0 ? 0 : delay_sum.seconds() / static_cast<double>(packets_out);
  }

  ChannelCounts& operator+=(const ChannelCounts& other);
};

}  // namespace skein::impairment
