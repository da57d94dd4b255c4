#pragma once

#include <string>

#include "scenario/kind_table.h"
#include "scenario/type.h"

namespace skein::scenario {

/// A JSON Schema (draft 2020-12) of files that hold `object`. It says all that the
/// description says; rules between keys and the existence of files are beyond it.
std::string schema_text(const Object& object, const KindTable& kinds);

}  // namespace skein::scenario
