// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace skein::assemble {

/// What stands in braces in the programs and paths of a scenario.
struct ProgramPlaces {
  std::vector<std::pair<std::string, std::string>> values;

  /// `text` with what stands for each {name} that is known.
  std::string filled(std::string text) const {
    for (const auto& [name, value] : values) {
      const std::string mark = "{" + name + "}";
      for (std::size_t at = text.find(mark); at != std::string::npos;
           at = text.find(mark, at + value.size()))
        text.replace(at, mark.size(), value);
    }
    return text;
  }
};

}  // namespace skein::assemble
