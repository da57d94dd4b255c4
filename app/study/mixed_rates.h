// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

#include "skein/assemble/radio/radio_file.h"
#include "skein/base/result.h"
#include "skein/link/modem/modem_peer.h"

namespace skein::app {

/// Who of three entities is real.
enum class MixedSetUp {
  kAllReal,       ///< all, each behind a socket of its own
  kMixed,         ///< one; two are simulated in the ground station
  kWithoutModel,  ///< the same, and what is simulated reaches all at once
};

inline constexpr std::size_t kMixedEntities = 3;
inline constexpr std::size_t kMixedBytes = 1000;  ///< of the payload of a message

/// Three entities at equal distances, each of which says kMixedBytes to the others again
/// and again.
/// Reference: [Selecky18] 6.4.1.
struct MixedRatesCase {
  MixedSetUp set_up = MixedSetUp::kAllReal;
  assemble::RadioFile radio;  ///< of all modems, real and simulated
  double rate = 15'000;       ///< of each entity's payload [bit/s]
  double duration = 30;       ///< that counts [s]
  std::uint64_t seed = 1;     ///< of the moments at which they begin
};

struct MixedRates {
  /// What each has received of each [B/s]: received[from][to].
  std::array<std::array<double, kMixedEntities>, kMixedEntities> received = {};
  modem::ModemStatistics station;  ///< of the ground station's modem, if there is one
};

/// Measures them in real time, in an mixed_network::MixedNetwork.
/// Fails: kUnavailable where they do not find each other, kInterrupted when stopped.
Result<MixedRates> measure_mixed_rates(const MixedRatesCase& given,
                                       const std::atomic<bool>& stop);

}  // namespace skein::app
