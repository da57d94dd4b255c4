// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "skein/geo/vec.h"

namespace skein::reasoning {

/// The visual flight rules, by what two aircraft are to each other.
enum class AirRule : std::uint8_t {
  kHeadOn,      ///< A1: both turn right
  kOvertaking,  ///< A2: passes on the right
  kOvertaken,   ///< A2: goes on
  kFromRight,   ///< A3: the other comes from the right: gives way behind it
  kFromLeft,    ///< A4: the other comes from the left: goes on
  kClimbing,    ///< A5: climbs or descends through the other's level: levels off
  kLevel,       ///< A5: the other climbs or descends through: goes on
  kUnable,      ///< A6: the other has a higher priority: gives way
  kPreferred,   ///< A6: the other has a lower one: goes on
  kSlowLower,   ///< A7: they close slowly, the other has right of way
  kSlowHigher,  ///< A7: they close slowly: goes on
};
constexpr auto names_of(const AirRule*) {
  return std::to_array<std::string_view>(
      {"head-on", "overtaking", "overtaken", "from-right", "from-left", "climbing",
       "level", "gives-way", "preferred", "slow-gives-way", "slow-preferred"});
}

/// How an aircraft moves when two come near.
struct AirMotionState {
  Vec3 p_N = Vec3::Zero();  ///< [m]
  Vec3 v_N = Vec3::Zero();  ///< over ground [m/s]
};

/// Who of two is to fly on, whatever the geometry.
enum class Standing : std::uint8_t { kEqual, kOwnHigher, kOtherHigher };

/// The rule that holds for the first of two.
///
/// @param standing  by priority class; for equal ones geometry decides.
/// @param own_id_lower  decides what geometry leaves open, the same on both sides.
/// Reference: spec/team.md section 4, A1 to A7.
AirRule rule_for(const AirMotionState& own, const AirMotionState& other,
                 Standing standing, bool own_id_lower);

/// Whether the rule has its aircraft change its flight.
constexpr bool acts(AirRule rule) {
  return rule == AirRule::kHeadOn || rule == AirRule::kOvertaking ||
         rule == AirRule::kFromRight || rule == AirRule::kClimbing ||
         rule == AirRule::kUnable || rule == AirRule::kSlowLower;
}

}  // namespace skein::reasoning
