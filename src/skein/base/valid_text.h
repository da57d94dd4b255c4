// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace skein {

/// What stands for a byte that is no text: U+FFFD, the replacement character.
inline constexpr std::string_view kReplacement = "\xEF\xBF\xBD";

/// Whether text is UTF-8 without the character NUL.
/// Cost: one pass; plain ASCII eight bytes at a time.
bool is_valid_text(std::string_view text);

/// Text from outside as everything behind the border holds it: UTF-8 without NUL. Each
/// byte that begins no character, and each NUL, becomes U+FFFD; valid text stays as it
/// is, so that doing it twice changes nothing.
///
/// Every reader of text that Skein did not write itself calls it, once, where the text
/// comes in, so that records, JSON, databases and pages never meet anything else:
/// commands (data/command/command_text.h), fields of MAVLink messages
/// (link/mavlink/payload.h), values in their wire form (data/describe/wire.h: other
/// hosts, modems, stored blobs), texts of a database (record/store/sqlite.h), tables and
/// attributes of files, names in a file of tokens. What libraries check themselves needs
/// no call: JSON and YAML that are no UTF-8 are refused, WebSocket texts too. Names of
/// files stay the bytes that the system knows them by; what is shown or recorded of them
/// passes through here.
///
/// Control characters stay: shown_text.h makes text fit for a terminal.
std::string valid_text(std::string text);

/// The same of text that lies elsewhere.
inline std::string valid_text(std::string_view text) {
  return valid_text(std::string(text));
}
inline std::string valid_text(const char* text) {
  return valid_text(std::string(text ? text : ""));
}

}  // namespace skein
