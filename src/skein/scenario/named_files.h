// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "skein/scenario/kind_table.h"
#include "skein/scenario/scenario.h"

namespace skein::scenario {

/// The paths of all files and folders that a scenario names, each once, in order. They
/// are absolute when the scenario was read from a file.
std::vector<std::string> named_files(const Scenario& scenario, const KindTable& kinds);

/// The commands that a scenario names, program and arguments, in the order of its keys:
/// whoever runs it starts them. Fields::program() marks such keys, those of plugins too.
std::vector<std::vector<std::string>> named_commands(const Scenario& scenario,
                                                     const KindTable& kinds);

}  // namespace skein::scenario
