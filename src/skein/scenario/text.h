// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace skein::scenario {

/// The byte offset of the first error: not UTF-8, or a control character other than tab,
/// line feed and carriage return. None when the text is valid.
std::optional<std::size_t> first_bad_byte(std::string_view text);

/// Minimum number of insertions, deletions, changes and swaps of neighbours that turn one
/// word into the other (optimal string alignment).
int edit_distance(std::string_view a, std::string_view b);

/// The name that `word` is probably a slip of: at most a third of its letters away. Empty
/// when none is near. The first of several equally near ones.
std::string nearest_name(std::string_view word, std::span<const std::string> names);

/// `text` in quotation marks, shortened to be read in a message.
std::string quote(std::string_view text);

/// A file's path in quotation marks; of a very long one the end, which names the file.
std::string quote_path(std::string_view path);

/// "a, b or c".
std::string any_of(std::span<const std::string> names);

}  // namespace skein::scenario
