// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace skein::scenario {

/// Seconds since 1970-01-01T00:00:00Z of a moment written as `2026-07-01T12:00:00Z`.
/// None for any other form and for days and times that do not exist; years 1970 to 2200.
std::optional<std::int64_t> parse_utc(std::string_view text);

/// The same moment as text: what parse_utc() reads.
std::string utc_text(std::int64_t seconds);

}  // namespace skein::scenario
