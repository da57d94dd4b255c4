// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <string>

namespace skein::scenario {

/// Where the text of a file came from. Whoever wrote it named the code that it asks for:
/// by this it is decided whether that code may run.
struct Source {
  /// Without symbolic links, as it was opened; empty: a text that came without a file.
  std::filesystem::path file;
  /// Where its relative paths start, without symbolic links; empty: unknown.
  std::filesystem::path folder;
  /// The bytes that were read. Null: nothing was.
  std::shared_ptr<const std::string> text;
};

}  // namespace skein::scenario
