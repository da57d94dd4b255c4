// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "skein/base/result.h"
#include "skein/link/mavlink/signing.h"

namespace skein::mavlink {

/// Reads the key of links from a file that only its owner can read. It holds one of
///
///   32 bytes                      the key itself
///   64 hexadecimal digits         the same, written out
///   passphrase: some text         the key is the text's SHA-256, as with ground stations
///
/// with or without the end of a line after the latter two.
///
/// Fails: kNotFound, kUnavailable where it cannot be read; kBadInput for a file that
/// others can read or write, that is no plain file, or that holds something else. No
/// message shows what it holds.
Result<SigningKey> read_signing_key(const std::filesystem::path& file);

}  // namespace skein::mavlink
