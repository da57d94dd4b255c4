// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace skein::record {

/// What records, messages, tasks and commands look like in JSON, as TypeScript
/// interfaces.
std::string records_typescript();

/// The tables of a run database that follow from descriptions, as rows of Markdown.
std::string records_markdown();

}  // namespace skein::record
