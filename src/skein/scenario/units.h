// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace skein::scenario {

/// A unit as it ends a key: `speed_mps` is in metres per second.
struct Unit {
  std::string_view suffix;    ///< "mps"
  std::string_view symbol;    ///< "m/s"
  std::string_view quantity;  ///< "speed": units of equal quantity convert
  double in_si;               ///< one of it in the SI unit of the quantity
};

/// The unit that `key` ends in; none when it ends in none.
std::optional<Unit> unit_of(std::string_view key);

/// `key` without its unit: "speed" of `speed_mps`.
std::string_view stem_of(std::string_view key);

/// Advice when `key` is one of `known` but for its unit or for lacking one: the known key
/// and, when `value` is a number of another unit, what it is in the known key's unit.
/// Empty when that is not what is wrong.
std::string unit_advice(std::string_view key, std::string_view value,
                        std::span<const std::string> known);

}  // namespace skein::scenario
