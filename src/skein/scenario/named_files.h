#pragma once

#include <string>
#include <vector>

#include "skein/scenario/kind_table.h"
#include "skein/scenario/scenario.h"

namespace skein::scenario {

/// The paths of all files and folders that a scenario names, each once, in order. They
/// are absolute when the scenario was read from a file.
std::vector<std::string> named_files(const Scenario& scenario, const KindTable& kinds);

}  // namespace skein::scenario
