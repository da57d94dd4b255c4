// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/scenario/type.h"

namespace skein::assemble {

/// Allowed values that parameters of several kinds share.
inline constexpr scenario::Range kNotNegative{.at_least = 0, .at_most = 1e6};

}  // namespace skein::assemble
