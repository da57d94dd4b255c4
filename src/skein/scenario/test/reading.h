// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "skein/scenario/scenario_file.h"

namespace skein::scenario::test {

/// Reads `text` as `test.yaml` in the folder of the sources.
ReadOutcome read_text(std::string_view text, const std::vector<std::string>& sets = {});

/// As read_text, for texts that must be valid; the problems become test failures.
Scenario read_good(std::string_view text, const std::vector<std::string>& sets = {});

/// All problems of a text, one per line.
std::string problems_of(std::string_view text, const std::vector<std::string>& sets = {});

}  // namespace skein::scenario::test
