// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "skein/scenario/scenario.h"

namespace skein::assemble {

/// A fingerprint of what a world and an agent in another program must have in common to
/// understand each other: the origin, and the names and numbers of all entities.
std::string common_ground(const scenario::Scenario& scenario);

}  // namespace skein::assemble
