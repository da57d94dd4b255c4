// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace skein::impairment {

/// How further delays are distributed.
enum class JitterKind : std::uint8_t {
  kUniform,  ///< from 0 to `jitter`
  kNormal,   ///< about 0 with the standard deviation `jitter`; never before the packet
};

/// What one direction of a connection does to what passes.
struct Impairment {
  double delay = 0;   ///< from the end of transmission to arrival [s]
  double jitter = 0;  ///< further delay [s]; packets keep their order, so that a late one
                      ///< delays those behind it
  JitterKind jitter_kind = JitterKind::kUniform;
  double loss = 0;              ///< probability that a packet is lost after transmission
  double duplicate = 0;         ///< probability that a packet arrives twice
  double reorder = 0;           ///< probability that a packet is held back
  double reorder_delay = 0.05;  ///< how long it is held back [s]; others pass it
  double rate = 0;              ///< of transmission [bit/s]; 0: no limit
  std::uint32_t queue_bytes = 65'536;  ///< that wait or are transmitted; tail drop
  bool cut = false;                    ///< nothing is transmitted until this changes
};

/// New values for some members of an Impairment.
struct ImpairmentChange {
  std::optional<double> delay = {}, jitter = {};
  std::optional<JitterKind> jitter_kind = {};
  std::optional<double> loss = {}, duplicate = {}, reorder = {}, reorder_delay = {};
  std::optional<double> rate = {};
  std::optional<std::uint32_t> queue_bytes = {};
  std::optional<bool> cut = {};
};

void apply(const ImpairmentChange& change, Impairment& to);

/// One way through a connection of the ends a, which calls, and b, which is called.
enum class Direction : std::uint8_t { kToB = 0, kToA = 1 };
inline constexpr std::array kDirections = {Direction::kToB, Direction::kToA};

/// One or both of them.
enum class Directions : std::uint8_t { kBoth, kToB, kToA };

inline bool includes(Directions some, Direction one) {
  return some == Directions::kBoth ||
         (some == Directions::kToB) == (one == Direction::kToB);
}

inline std::size_t index_of(Direction direction) {
  return static_cast<std::size_t>(direction);
}

}  // namespace skein::impairment
