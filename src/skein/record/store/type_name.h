// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cctype>
#include <string>
#include <string_view>

namespace skein::record {

/// What a kind is called as a type: "range_scan" becomes RangeScan.
inline std::string type_name(std::string_view kind) {
  std::string name;
  bool capital = true;
  for (const char c : kind) {
    if (c == '_') {
      capital = true;
      continue;
    }
    name += capital ? static_cast<char>(std::toupper(static_cast<unsigned char>(c))) : c;
    capital = false;
  }
  return name;
}

}  // namespace skein::record
