#pragma once

#include <optional>
#include <string_view>

namespace skein::environment {

/// Seconds since 1970-01-01T00:00:00Z of an ISO 8601 date or date and time, such as
/// `2021-09-05T14:04:00-07:00`, `2021-09-05 14:04` or `2021-09-05T21:04:00.5Z`. Without a
/// zone it counts as UTC. None when the text is anything else.
std::optional<double> parse_utc(std::string_view text);

}  // namespace skein::environment
