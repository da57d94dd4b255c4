// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "skein/assemble/kinds/kinds.h"
#include "skein/role/path_planner.h"

namespace skein::assemble {

/// Planners need nothing besides their options.
struct PlannerContext {};

/// The planners of paths, one row each.
Kinds<PathPlanner, PlannerContext> planner_kinds();

/// A planner by its name, with the options of its kind as they are by default.
/// Fails: kBadInput for a name that is no row; the message lists those that are.
Result<std::unique_ptr<PathPlanner>> make_planner(const std::string& name);

}  // namespace skein::assemble
