// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <any>
#include <string>

#include "skein/base/check.h"

namespace skein::scenario {

/// A chosen implementation: the name of its kind and that kind's options struct. Empty
/// options stand for the kind's defaults; after reading they are always filled.
struct Choice {
  std::string kind;
  std::any options = {};

  /// The options. Fails: Bug when they are of another type, or empty.
  template <class Options>
  const Options& as() const {
    const auto* found = std::any_cast<Options>(&options);
    SKEIN_CHECK(found != nullptr, kind, options.type().name());
    return *found;
  }
};

}  // namespace skein::scenario
