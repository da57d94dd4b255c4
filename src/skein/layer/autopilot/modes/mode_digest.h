#pragma once

#include <cstdint>

#include "skein/layer/autopilot/modes/failsafe.h"

namespace skein::autopilot::mode_bits {

/// Places of the bits in ModeLogic's digest of its input. The first six are conditions,
/// in the order of Failsafe.
inline constexpr unsigned kUnhealthy = 6;
inline constexpr unsigned kPilotHeard = 7;
inline constexpr unsigned kPilotTakesOver = 8;
inline constexpr unsigned kPilotManual = 9;
inline constexpr unsigned kPilotLongSilent = 10;
inline constexpr unsigned kOnGround = 11;
inline constexpr unsigned kDone = 12;
inline constexpr unsigned kLanded = 13;
inline constexpr unsigned kCommitted = 14;
inline constexpr unsigned kHomeOutOfReach = 15;
inline constexpr unsigned kTaken = 16;  ///< tells a digest from none

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
