// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/base/random.h"
#include "skein/layer/asset/fixed_wing/parameters.h"
#include "skein/layer/asset/multirotor/multirotor_parameters.h"
#include "skein/layer/asset/performance/performance_parameters.h"

namespace skein::assemble {

/// Changes the parameters of an aircraft as if they had not been measured well: mass, all
/// inertias together, and each coefficient of forces, moments and thrust are multiplied
/// by numbers drawn uniformly from [1 - share, 1 + share].
///
/// What makes the aircraft fit for flight stays: geometry, limits, servos, battery.
void spread(asset::FixedWingParameters& parameters, double share, RandomStream random);
void spread(asset::MultirotorParameters& parameters, double share, RandomStream random);
void spread(asset::PerformanceParameters& parameters, double share, RandomStream random);

}  // namespace skein::assemble
