// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace skein::app {

/// Asks whoever sits at the terminal a question that `y` or `yes` answers; all else, an
/// end of file too, is no. What was typed before the question does not count. Ctrl-C
/// ends the program, as it does while nothing has begun.
/// @returns  false as well where standard input or standard error is no terminal.
bool ask_on_terminal(const std::string& question);

}  // namespace skein::app
