// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace skein {

/// Distances that two aircraft keep. They are apart when either is kept.
struct Separation {
  double horizontal = 50;  ///< [m]
  double vertical = 20;    ///< [m]

  /// How well distances keep it: they do from 1 on.
  double ratio(double horizontal_distance, double vertical_distance) const {
    return std::max(horizontal_distance / horizontal, vertical_distance / vertical);
  }
};

/// A pair keeps the larger distances of both members.
constexpr Separation larger(const Separation& a, const Separation& b) {
  return {std::max(a.horizontal, b.horizontal), std::max(a.vertical, b.vertical)};
}

/// How an aircraft keeps apart from others. The order is that in which they are called
/// for as time runs out.
enum class SeparationMethod : std::uint8_t {
  kNone,            ///< not at all
  kRule,            ///< each by the rules of the air, alone
  kPriority,        ///< the lower one plans around the higher one
  kNegotiated,      ///< the two agree on what both fly
  kGroup,           ///< all whose conflicts hang together agree
  kNonCooperative,  ///< out of the way of who says nothing of its plans
  kLastMoment,      ///< by heights: no time is left for anything else
  kAuto,            ///< whichever fits the time that is left and what the other can do
};
constexpr auto names_of(const SeparationMethod*) {
  return std::to_array<std::string_view>({"none", "rule", "priority", "negotiated",
                                          "group", "non-cooperative", "last-moment",
                                          "auto"});
}

/// A separation by its name.
struct NamedSeparation {
  std::string_view name;
  Separation separation;
};

/// Small aircraft among themselves; light-sport aircraft; from an intruder that may carry
/// people; near mid-air collision.
inline constexpr std::array<NamedSeparation, 4> kSeparations{
    {{"team", {50, 20}},
     {"light", {1500, 150}},
     {"well-clear", {609.6, 76.2}},
     {"nmac", {152.4, 30.48}}}};

/// None where no separation has that name.
constexpr std::optional<Separation> separation_named(std::string_view name) {
  for (const NamedSeparation& each : kSeparations)
    if (each.name == name) return each.separation;
  return std::nullopt;
}

}  // namespace skein
