#pragma once

#include <filesystem>
#include <string_view>

#include "skein/base/result.h"

namespace skein::record {

/// Writes a text file that appears whole or not at all: under another name first.
/// Fails: kUnavailable when it cannot be written.
Result<void> write_file(const std::filesystem::path& file, std::string_view text);

}  // namespace skein::record
