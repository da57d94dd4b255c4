// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/assemble/kinds/kind_registry.h"

namespace my_kinds {

/// Adds the estimator `circle`, the sensor `radiometer` and the agent `smoke-watch`.
void add_kinds(skein::assemble::KindsByRole& kinds);

}  // namespace my_kinds
