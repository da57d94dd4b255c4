// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "skein/base/result.h"
#include "skein/scenario/problem.h"

namespace skein::scenario {

/// The text of a file with its former names replaced by those of today. Everything else,
/// comments and blanks among it, stays byte for byte.
///
/// @param name     of the file, for messages.
/// @param renames  as reading the text found them (Reading::renames).
/// Fails: kBadInput: a name does not stand where it was found, as in a text that is not
///        the one that was read.
Result<std::string> with_new_names(std::string_view text, const std::string& name,
                                   std::span<const Rename> renames);

/// The lines in which two texts of as many lines differ, as `diff` shows them: "-" and
/// "+" before them, the number of the line above.
std::string changed_lines(std::string_view before, std::string_view after);

}  // namespace skein::scenario
