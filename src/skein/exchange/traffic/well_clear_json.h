// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "skein/base/result.h"
#include "skein/model/well_clear/configuration.h"

namespace skein::exchange {

/// Reads a configuration of alerts and bands: a JSON object with the keys of
/// docs/well-clear.md, all of them; `source` (a text) may be left out.
///
/// @param place  name of the file, for messages.
/// Fails: kBadInput naming the key and what is allowed: no JSON, a key that is unknown,
///        missing or there twice, a value of another type, and as model::check().
Result<model::WellClearConfiguration> well_clear_configuration_from_json(
    std::string_view text, const std::string& place);

/// The configuration as such a file.
std::string to_json(const model::WellClearConfiguration& configuration);

}  // namespace skein::exchange
