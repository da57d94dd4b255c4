// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "skein/geo/vec.h"

/// The words of a line that a person has typed.
namespace skein::words {

/// The words of a line, which blanks part.
std::vector<std::string_view> split(std::string_view line);

/// A finite or infinite number; nothing when the word is none.
std::optional<double> number(std::string_view word);

/// A place NORTH,EAST; nothing when the word is none.
std::optional<Vec2> place(std::string_view word);

}  // namespace skein::words
