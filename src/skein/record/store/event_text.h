// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace skein::record {

/// docs/events.md: all kinds of event, by subject.
std::string events_markdown();

/// What the pages know of kinds of event: a constant for TypeScript.
std::string events_typescript();

}  // namespace skein::record
