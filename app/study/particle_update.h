// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/model/probability/truncated_normal.h"

namespace skein::app {

/// What the shipped particle estimator (1,000 samples, no false readings) makes of a
/// range N(mean, variance) that is reported to be on one side of a bound.
/// @param sigma_v  standard deviation of the bound [m], positive.
model::Moments particle_update(double mean, double variance, double bound,
                               model::Side side, double sigma_v);

}  // namespace skein::app
