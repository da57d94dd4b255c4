// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace skein {

/// Bytes of the UTF-8 character that `text` (not empty) begins with; 0 when it begins
/// with none. Overlong forms, surrogates and what lies above U+10FFFF are none.
/// Reference: RFC 3629, section 4.
std::size_t utf8_length(std::string_view text);

/// Text as a terminal may be given it, whatever file or name it comes from: what would
/// steer the terminal or disguise the text stands there by its number.
///
/// Bytes below 0x20 but line feed and tabulator, 0x7f, and bytes that are no UTF-8 become
/// `\x1b`; C1 controls (U+0080 to U+009F), the separators U+2028 and U+2029, and what
/// changes the direction of writing (Unicode's Bidi_Control) or cannot be seen (U+200B,
/// U+FEFF, tags from U+E0000) become `\u202e`. Everything else stays.
std::string shown(std::string_view text);

}  // namespace skein
