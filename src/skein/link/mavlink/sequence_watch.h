// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <utility>

#include "skein/link/mavlink/frame.h"

namespace skein::mavlink {

/// Counts what was lost on the way, by the counts that senders put into their frames.
class SequenceWatch {
 public:
  void hear(const Frame& frame) {
    const std::uint8_t now = frame.sequence();
    const auto [last, first] =
        last_.try_emplace(std::pair(frame.system(), frame.component()), now);
    if (!first) {
      const auto missing = static_cast<std::uint8_t>(now - last->second - 1);
      if (missing == 255) return;  // repeated
      if (missing < 128)
        lost_ += missing;
      else if (missing >= 256 - kOvertaking && lost_ > 0)
        --lost_;  // it comes late
      // In between the sender has begun anew.
      if (missing < 256 - kOvertaking) last->second = now;
    }
    ++heard_;
  }

  std::uint64_t heard() const { return heard_; }
  std::uint64_t lost() const { return lost_; }
  /// Share of what was sent, from 0 to 1.
  double loss() const {
    const auto sent = static_cast<double>(heard_ + lost_);
    return sent > 0 ? static_cast<double>(lost_) / sent : 0;
  }

 private:
  static constexpr int kOvertaking = 16;  // frames that one may overtake

  std::map<std::pair<std::uint8_t, std::uint8_t>, std::uint8_t> last_;
  std::uint64_t heard_ = 0, lost_ = 0;
};

}  // namespace skein::mavlink
