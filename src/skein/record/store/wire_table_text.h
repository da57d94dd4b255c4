// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace skein::record {

/// How the messages of the live feed lie in their bytes, as a TypeScript table that the
/// page's decoder goes by (docs/live-feed.md).
std::string wire_table_typescript();

}  // namespace skein::record
