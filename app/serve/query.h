// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "skein/base/result.h"
#include "skein/layer/hmi/serve/web_server.h"

namespace skein::serve {

/// The parameters of a query (what follows the question mark of an address), by name.
///
/// Values are UTF-8; `%20` and `+` are blanks in them.
/// @param allowed  the names that there may be.
/// Fails: kBadInput, naming the parameter and what is allowed, for another name, one
/// given
///        twice, a broken %-code, and a value that is no text or longer than 255 bytes.
Result<std::map<std::string, std::string>> read_query(
    std::string_view query, std::span<const std::string_view> allowed);

/// The answer 400, as JSON, when such a query would not be obeyed in full; none when it
/// would.
std::optional<hmi::HttpAnswer> refused_query(std::string_view query,
                                             std::span<const std::string_view> allowed);

}  // namespace skein::serve
