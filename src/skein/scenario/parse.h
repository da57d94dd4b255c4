// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "skein/scenario/node.h"
#include "skein/scenario/problem.h"

namespace skein::scenario {

/// What a source may hold at most; far above any real scenario, and small enough that an
/// answer takes seconds and no hostile file exhausts memory.
struct ParseLimits {
  static constexpr std::size_t kBytes = 20'000'000;
  static constexpr std::size_t kValues = 2'500'000;
  static constexpr std::size_t kCopiedValues = 200'000;  ///< through anchors and aliases
  static constexpr int kDepth = 40;
};

/// The tree of one YAML text. Nothing is interpreted: numbers stay text.
///
/// @param source  number of the source in `problems`.
/// @param name    what it is, with its article, for messages: "a scenario".
/// @returns  the tree; none after a syntax error, or when the text holds no value. Keys
///           given twice are reported and the first is kept.
/// Fails:    through `problems`: not UTF-8, control characters, syntax, limits, tags,
///           several documents, keys that are not text.
std::optional<Node> parse_yaml(std::string_view text, std::int32_t source,
                               std::string_view name, Problems& problems);

}  // namespace skein::scenario
