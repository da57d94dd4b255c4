// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <string>

#include "skein/assemble/radio/radio_file.h"
#include "skein/base/result.h"

namespace skein::app {

inline constexpr std::size_t kDeliveryEntities = 3;

/// Three entities in reach of each other, and a house between the first two that no
/// signal passes.
/// Reference: [Selecky18] 6.4.2.
struct MixedDeliveryCase {
  std::array<bool, kDeliveryEntities> real = {};  ///< who has a modem of its own
  assemble::RadioFile radio;  ///< of all modems, real and simulated; the house is added
  int messages = 20;          ///< that each says to all others, one after another
  std::uint64_t seed = 1;
};

/// Share of what `from` has said that `to` has received: delivered[from][to].
using DeliveryMatrix =
    std::array<std::array<double, kDeliveryEntities>, kDeliveryEntities>;

/// "real, simulated, real".
std::string name_of(const std::array<bool, kDeliveryEntities>& real);

/// Measures it in real time, in an mixed_network::MixedNetwork.
/// Fails: kUnavailable where they do not find each other, kInterrupted when stopped.
Result<DeliveryMatrix> measure_mixed_delivery(const MixedDeliveryCase& given,
                                              const std::atomic<bool>& stop);

}  // namespace skein::app
