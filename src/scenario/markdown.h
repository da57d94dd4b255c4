#pragma once

#include <string>

#include "scenario/kind_table.h"
#include "scenario/type.h"

namespace skein::scenario {

/// Tables of every key of `object`, a section for each group of keys, then the kinds of
/// every role with their keys.
std::string keys_as_markdown(const Object& object, const KindTable& kinds);

}  // namespace skein::scenario
