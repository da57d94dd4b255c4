// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace skein::app {

/// The version and the build: "0.1.0+g3e858957c0", ".dirty" when files were changed since
/// that commit; without git "0.1.0+src" and a hash of the sources.
extern const char* const kVersion;

/// What changes with every change of the program: a hash of the executable file.
std::string program_fingerprint();

}  // namespace skein::app
