// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "skein/assemble/kinds/kind_registry.h"
#include "skein/scenario/document.h"
#include "skein/scenario/kind_table.h"

namespace skein::app {

/// What a file other than a scenario is made of, by its name: aircraft, radio, relay,
/// campaign; null: any other name.
const scenario::Document* document_of(std::string_view name);

/// The kinds that such a file may name.
scenario::KindTable table_of(std::string_view document,
                             const assemble::KindRegistry& kinds);

/// What a YAML file is, by the keys at its top: the name of the document that knows most
/// of them, or "scenario", which is also said of a text that is no YAML.
std::string_view format_of(std::string_view text);

}  // namespace skein::app
