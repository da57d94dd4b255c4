// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <string>

#include "skein/base/result.h"

namespace skein {

/// Larger files are not read in one go [bytes].
inline constexpr std::size_t kMaxFileBytes = 500'000'000;

/// Reads a whole file; every file that is read in one go is read by this.
///
/// Links are followed; pipes and devices are read to their end.
/// @param max_bytes  that are allowed.
/// @returns          the bytes as they are; none for an empty file.
/// Fails: kNotFound when there is nothing; kBadInput for a folder, and for more than
///        `max_bytes`; kUnavailable when it cannot be opened or read, with the reason.
Result<std::string> read_file(const std::filesystem::path& file,
                              std::size_t max_bytes = kMaxFileBytes);

/// Opens a file that is read piece by piece. A stream opened without this reads a folder
/// as if it were empty.
/// Fails: as read_file().
Result<std::ifstream> open_input(const std::filesystem::path& file);

}  // namespace skein
