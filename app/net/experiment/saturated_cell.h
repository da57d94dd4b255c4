// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "skein/layer/communication/medium/radio_profile.h"

namespace skein::experiment {

/// What theory says of a cell in which every station always has something to send.
struct SaturatedCell {
  double transmission_probability = 0;  ///< of a station in a slot
  double collision_probability = 0;     ///< of a transmission
  double throughput = 0;                ///< of payload, all stations together [bit/s]
};

/// Bianchi's model of the distributed coordination function.
///
/// With W = cw_min + 1 and m doublings of the contention window, a station sends in a
/// slot with probability tau, and a transmission collides with probability p:
///
///   tau = 2 / (1 + W + p W sum_{i<m} (2p)^i),   p = 1 - (1 - tau)^(n-1)
///
/// With at most R transmissions of a message,
///
///   tau = sum_{i<R} p^i / sum_{i<R} p^i (W 2^min(i,m) + 1) / 2
///
/// The fixed point is unique. A slot is idle with probability 1 - P, holds a success with
/// P_s and a collision with the rest, and lasts sigma, T_s or T_c:
///
///   throughput = 8 bytes P_s / ((1 - P) sigma + P_s T_s + (P - P_s) T_c)
///   T_s = DATA + SIFS + ACK + DIFS,   T_c = DATA + DIFS
///
/// and with RTS, if the frame of `bytes` is longer than the threshold,
/// T_s = RTS + CTS + DATA + ACK + 3 SIFS + DIFS, T_c = RTS + DIFS.
///
/// @param stations  at least 2, all within reach of each other
/// @param bytes  of payload of every message
/// @param transmissions  R, at least 1; none: a message is repeated until it is received
/// Valid: no bit errors, no hidden stations; collisions and time-outs last equally long
///   for all.
/// Reference: [Bianchi00] Eqs. (7), (9), (13), (14), (17); [Wu02] for R.
SaturatedCell saturated_cell(std::uint32_t stations,
                             const communication::RadioProfile& radio,
                             std::uint32_t bytes,
                             std::optional<std::uint32_t> transmissions = std::nullopt);

}  // namespace skein::experiment
