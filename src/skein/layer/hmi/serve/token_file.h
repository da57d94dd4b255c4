// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "skein/base/result.h"
#include "skein/layer/hmi/serve/access.h"

namespace skein::hmi {

/// The tokens in a file (AccessTable::parse).
///
/// Fails: kNotFound for a file that cannot be read; kBadInput for one that others than
/// its owner can read or write, that belongs to somebody else than who runs the program
/// or the system's administrator, or of more than a megabyte; as AccessTable::parse().
Result<AccessTable> read_token_file(const std::string& file);

}  // namespace skein::hmi
