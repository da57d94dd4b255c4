// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "skein/scenario/document.h"
#include "skein/scenario/kind_table.h"

namespace skein::scenario {

/// A JSON Schema (draft 2020-12) of such files. It says all that the description says;
/// rules between keys and the existence of files are beyond it.
std::string schema_text(const Document& document, const KindTable& kinds);

}  // namespace skein::scenario
