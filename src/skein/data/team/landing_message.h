// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "skein/data/describe/describe.h"

// What aircraft say to each other that come home to one landing place.

namespace skein {

/// How far an aircraft is that wants to land where others do too.
enum class LandingPhase : std::uint8_t {
  kWaits,   ///< for its turn, at a height of its own
  kClaims,  ///< takes the turn soon, unless somebody objects who goes before
  kLands,   ///< has the turn
  kLanded,  ///< stands on the ground
  kLeaves,  ///< does not want to land there any more
};
constexpr auto names_of(const LandingPhase*) {
  return std::to_array<std::string_view>(
      {"waits", "claims", "lands", "landed", "leaves"});
}

/// The sender wants to land, or has landed; to everyone, once a second.
struct LandingReport {
  LandingPhase phase = LandingPhase::kWaits;
  float north = 0, east = 0;  ///< where [m]
  float course = 0;           ///< of approaches, as the sender has it [rad]
  float altitude_msl = 0;     ///< at which it waits [m]
  float since = 0;            ///< it has wanted to land, on the run's clock [s]
  float endurance = 0;        ///< flight time left [s]; a day while it is not known
  float lasts = 0;            ///< until it stands, if it has the turn from now on [s]
  std::uint8_t attempts = 0;  ///< turns that it has given back
  bool emergency = false;     ///< it lands without a turn: a failsafe flies
  bool committed = false;     ///< so low that it breaks off no more
};

constexpr auto describe(const LandingReport*) {
  using T = LandingReport;
  return described<T>(
      {"landing_report"}, "The sender wants to land, or has landed.",
      field("phase", &T::phase, "how far it is"),
      field("north", &T::north, unit::kMetre, "where it lands"),
      field("east", &T::east, unit::kMetre, "where it lands"),
      field("course", &T::course, unit::kDegree, "of approaches"),
      field("altitude_msl", &T::altitude_msl, unit::kMetre, "at which it waits"),
      field("since", &T::since, unit::kSecond, "when it began to want that"),
      field("endurance", &T::endurance, unit::kSecond, "flight time left"),
      field("lasts", &T::lasts, unit::kSecond, "until it stands, from now on"),
      field("attempts", &T::attempts, "turns that it has given back"),
      field("emergency", &T::emergency, "it lands without a turn"),
      field("committed", &T::committed, "it breaks off no more"));
}

}  // namespace skein
