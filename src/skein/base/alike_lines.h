// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace skein {

/// Makes one line of those from index `first` on that differ in their numbers only, where
/// there are more than three: the first of them, with how many more there are. Their
/// order stays. A file with hundreds of alike oddities gives one warning, not hundreds.
void join_alike_lines(std::vector<std::string>& lines, std::size_t first = 0);

}  // namespace skein
