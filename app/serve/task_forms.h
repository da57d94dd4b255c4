// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>

namespace skein::serve {

/// What a page needs to ask a person for a task of each kind, as JSON: kind, help, and
/// for each field its names in a command, what it is, unit, help and default
/// (docs/live-feed.md). Follows from the tasks' descriptions.
nlohmann::ordered_json task_forms();

}  // namespace skein::serve
