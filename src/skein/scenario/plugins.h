// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

#include "skein/base/result.h"
#include "skein/scenario/problem.h"
#include "skein/scenario/source.h"

namespace skein::scenario {

struct Folders;
struct Node;

/// Makes the kinds of a shared library known; from then on they stand in the table that
/// the scenario is read with.
///
/// @param file      absolute.
/// @param named_in  the scenario that asks for it.
using LoadPlugin =
    std::function<Result<void>(const std::string& file, const Source& named_in)>;

/// For callers who have loaded all plugins before, so that their table holds the kinds.
LoadPlugin plugins_are_loaded();

/// Loads what the key `plugins` of a scenario names, before anything else is read: other
/// keys may name kinds of these. What cannot be loaded becomes a problem at its place.
/// @returns  whether all were loaded.
bool load_plugins(const Node& root, const Folders& folders, const LoadPlugin& load,
                  Problems& problems);

}  // namespace skein::scenario
