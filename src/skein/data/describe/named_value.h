// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "skein/data/describe/describe.h"

namespace skein {

/// A number with a name.
struct NamedValue {
  std::string name;  ///< with its unit
  double value = 0;
};

constexpr auto describe(const NamedValue*) {
  using T = NamedValue;
  return described<T>({"named_value"}, "A number with a name.",
                      field("name", &T::name, "with its unit"),
                      field("value", &T::value, "in that unit; null: not known"));
}

}  // namespace skein
