// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "skein/base/time.h"

namespace skein::scenario {

/// The number that `text` is as a whole: decimal, exponent allowed, and YAML's words for
/// infinity and not-a-number. None for anything else and for what a double cannot hold.
std::optional<double> parse_number(std::string_view text);
std::optional<std::int64_t> parse_integer(std::string_view text);

/// The shortest text that parse_number turns into `number` again.
std::string number_text(double number);
/// `time` in seconds, exactly.
std::string seconds_text(Time time);

/// The shortest text in degrees whose reading gives `radians` again, or, for the angles
/// that no number of degrees gives, a neighbour of it (one rounding away).
std::string degrees_text(double radians);

}  // namespace skein::scenario
