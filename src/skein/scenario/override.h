// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "skein/scenario/node.h"
#include "skein/scenario/problem.h"

namespace skein::scenario {

/// A change to a scenario from outside its file, as on the command line:
/// `aircraft[0].plant.airspeed_mps=25`. The value is YAML; lists count from 0, and one
/// past the end appends.
struct Override {
  std::string text;
  /// Where relative paths in it start, such as the folder of the campaign that has it;
  /// empty: the working folder, as for what stands on a command line.
  std::filesystem::path folder = {};
};

/// Puts an override into a parsed tree, in place of what stands there. Where the tree
/// says nothing, Node::patch marks what was made. Whether the keys exist is seen on
/// reading.
///
/// @param source  its number in `problems`.
/// Fails:    through `problems`: no `=`, a path that is none, an index past the end, an
///           index into something else than a list, a value that is not YAML.
void apply_override(const Override& change, std::int32_t source, Node& root,
                    Problems& problems);

}  // namespace skein::scenario
