// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/model/connection/connection.h"

namespace skein::model::test {

/// The earliest meeting by any of the six words before `until`, found by looking at all
/// lengths at `steps` moments and refining where a length and the time flown cross: slow,
/// and independent of how `connect` solves it. The lengths are those of [Shkel01].
/// Infinite when there is none.
///
/// Times in seconds.
double dense_search(const ConnectionQuery& query, double until, int steps);

/// Cases to compare on: random ones in a box of 20 or 4 turn radii with wind up to 0.95
/// of the airspeed, and hard ones (see dense_search.cpp).
ConnectionQuery random_case(std::uint32_t number);
ConnectionQuery hard_case(std::uint32_t number);
/// From 1e-9 to 1e4 turn radii away, in winds from 1e-12 of the airspeed to 1e-9 below
/// it.
ConnectionQuery extreme_case(std::uint32_t number);

/// How far the flown connection ends from the goal: turn radii, or rad of heading if that
/// is more. Infinite when nothing was found.
double end_error(const ConnectionQuery& query, const Connection& connection);

}  // namespace skein::model::test
