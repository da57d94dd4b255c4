// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "skein/layer/autopilot/modes/failsafe.h"

namespace skein::autopilot::mode_bits {

/// Places of the bits in ModeLogic's digest of its input. The first seven are conditions,
/// in the order of Failsafe.
inline constexpr unsigned kUnhealthy = 7;
inline constexpr unsigned kPilotHeard = 8;
inline constexpr unsigned kPilotTakesOver = 9;
inline constexpr unsigned kPilotManual = 10;
inline constexpr unsigned kPilotLongSilent = 11;
inline constexpr unsigned kOnGround = 12;
inline constexpr unsigned kDone = 13;
inline constexpr unsigned kLanded = 14;
inline constexpr unsigned kCommitted = 15;
inline constexpr unsigned kHomeOutOfReach = 16;
inline constexpr unsigned kTaken = 17;  ///< distinguishes a digest from none

constexpr std::uint32_t bit(bool value, unsigned place) {
  return static_cast<std::uint32_t>(value) << place;
}
constexpr bool has(std::uint32_t digest, unsigned place) {
  return (digest >> place & 1u) != 0;
}
constexpr unsigned place(Failsafe failsafe) {
  return static_cast<unsigned>(failsafe);
}

}  // namespace skein::autopilot::mode_bits
