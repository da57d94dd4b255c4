// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace skein::record {

/// Who has been off the ground for at least so long flies; for shorter it jumps: landing
/// gear springs, and gusts lift what stands [s].
inline constexpr double kGroundTime = 3;

}  // namespace skein::record
