// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "skein/data/event/live.h"

namespace skein::serve {

// What a map without a server needs of a run. Numbers are rounded to fractions that are
// powers of two: what is left of them compresses well, in the wire form as it is.

/// The record as a map shows it: places to 1/16 m, true perimeters without the points
/// that do not matter, of beliefs only where they are and how sure that is. Nothing for
/// what no map shows.
std::optional<Record> for_map(const Record& record);

/// Aircraft as a map shows them: places to 1/16 m, what is not drawn left out.
FleetFrame for_map(FleetFrame frame);
TruthFrame for_map(TruthFrame frame);

/// A closed line without the points that are nearer than `tolerance` [m] to a line
/// through others. Reference: [Douglas73].
geo::Ring simplified(const geo::Ring& ring, double tolerance);

}  // namespace skein::serve
