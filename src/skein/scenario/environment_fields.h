// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <initializer_list>

#include "skein/scenario/fields.h"
#include "skein/scenario/scenario.h"

// The keys of what surrounds the aircraft: see scenario_fields.cpp.

namespace skein::scenario {

inline constexpr Range kLength{.above = 0, .at_most = 1e6};
inline constexpr Range kPeriod{.at_least = 0.001, .at_most = 3600};
inline constexpr Range kBearing{.at_least = -360, .at_most = 360};

Fields<Environment> environment_fields();
Fields<TrafficGroup> traffic_fields();

/// What aircraft may carry by which others notice them.
std::initializer_list<Word<Transmitter>> transmitter_words();

}  // namespace skein::scenario
