// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "skein/base/time.h"
#include "skein/data/describe/describe.h"

namespace skein {

/// A record of a plugin's own kind: `coded` is best made by wire::encode().
struct PluginRecord {
  Time time;
  std::string kind;  ///< starts with the plugin's name
  std::vector<std::uint8_t> coded;
};

constexpr auto describe(const PluginRecord*) {
  using T = PluginRecord;
  return described<T>(
      {"plugin_record", "plugin_records"}, "A value that a plugin has recorded.",
      field("time", &T::time, "when"), field("plugin_kind", &T::kind, "what it is"),
      field("coded", &T::coded, Storage::kBytes, "its bytes"));
}

}  // namespace skein
