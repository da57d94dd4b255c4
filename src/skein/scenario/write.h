// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "skein/scenario/kind_table.h"
#include "skein/scenario/node.h"
#include "skein/scenario/type.h"

namespace skein::scenario {

/// The tree of a value, everything written out; the opposite of Reader::read.
Node to_node(const Type& type, const void* value, const KindTable& kinds);

/// The tree as YAML text that parses to it again, ending in a line feed.
std::string to_yaml(const Node& node);

/// The same on one line, as `[1, 2]` or `{kind: joint, harmonics: 12}`.
std::string to_inline_yaml(const Node& node);

}  // namespace skein::scenario
