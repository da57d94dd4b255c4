// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "skein/base/time.h"

namespace skein::communication {

/// A radio of the medium, counted from 0.
using NodeIndex = std::uint32_t;
/// As receiver: all that hear it.
inline constexpr NodeIndex kAllNodes = 0xFFFFFFFFu;

enum class FrameKind : std::uint8_t { kData, kAck, kRts, kCts };

/// Of control frames, with their check sequence: [802.11] 9.3.1.
inline constexpr std::uint32_t kAckBytes = 14, kCtsBytes = 14, kRtsBytes = 20;

/// What is sent in one go.
struct Frame {
  FrameKind kind = FrameKind::kData;
  NodeIndex from = 0;
  NodeIndex to = 0;             ///< or kAllNodes
  std::uint32_t packet = 0;     ///< of data: its place among the packets
  std::uint64_t tag = 0;        ///< of data and RTS: the number that its user gave
  std::uint32_t mac_bytes = 0;  ///< with header and check sequence
  Time duration;                ///< on the air, with preamble
  Time reserved = {};           ///< what its duration field asks others to wait after it
  double power = 1;             ///< share of its sender's full power, above 0
  bool noise = false;           ///< nobody can decode it
};

/// How a frame arrived at a receiver.
struct Reception {
  double power = 0;  ///< [W]
  double sinr = 0;   ///< the least ratio of signal to noise and interference
};

}  // namespace skein::communication
