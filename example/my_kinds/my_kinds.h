#pragma once

#include "skein/assemble/kind_registry.h"

namespace my_kinds {

/// Adds the estimator `circle` and the sensor `radiometer`.
void add_kinds(skein::assemble::KindsByRole& kinds);

}  // namespace my_kinds
