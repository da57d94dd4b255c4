// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <string_view>
#include <utility>

#include "skein/base/shown_text.h"

namespace skein::app {

/// Puts text on standard output as it is: documents, tables for other programs. Never
/// throws: whether all of it got there is asked once, by finish_output().
void put_out(std::string_view text);
/// As put_out(), and not held back: a reader at the other end of a pipe has it at once.
/// @returns false when output is lost or nobody reads any more, so that more is in vain.
bool put_out_now(std::string_view text);
/// Puts text on standard error, as shown() has it. Never throws: there is nobody left to
/// read it.
void put_err(std::string_view text);

/// Puts lines for people on standard output, as shown() has them: names and words of
/// files cannot steer the terminal.
template <class... Values>
void print(fmt::format_string<Values...> format, Values&&... values) {
  put_out(shown(fmt::format(format, std::forward<Values>(values)...)));
}
/// As print(), on standard error.
template <class... Values>
void complain(fmt::format_string<Values...> format, Values&&... values) {
  put_err(fmt::format(format, std::forward<Values>(values)...));
}

/// Writes out what standard output still holds. Call once, at the end of the program.
///
/// @returns `status`; kFailed instead of kDone when output was lost, after saying so. A
///          reader that has gone (`| head`) has all it needs: no failure.
int finish_output(int status);

}  // namespace skein::app
