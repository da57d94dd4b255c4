// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "skein/data/team/task_form.h"

namespace skein::serve {

/// What a page needs to ask a person for a task of each kind, as JSON: kind, help, and
/// fields with their types, units and what they are when nothing is entered
/// (docs/live-feed.md).
nlohmann::ordered_json task_forms(const TaskForms& forms);

}  // namespace skein::serve
