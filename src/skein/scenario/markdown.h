// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "skein/scenario/document.h"
#include "skein/scenario/kind_table.h"

namespace skein::scenario {

/// Tables of every key of such a file, a section for each group of keys, then the kinds
/// of every role with their keys.
std::string keys_as_markdown(const Document& document, const KindTable& kinds);

}  // namespace skein::scenario
