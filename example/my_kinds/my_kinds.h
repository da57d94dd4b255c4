// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/assemble/kinds/kind_registry.h"

namespace my_kinds {

/// Adds the estimator `circle`, the sensor `radiometer`, the agent `smoke-watch` and the
/// task `expanding_square`.
void add_kinds(skein::assemble::KindsByRole& kinds);

}  // namespace my_kinds
