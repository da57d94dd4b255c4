// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "skein/solve/coverage/coverage.h"

namespace skein::solve {

inline constexpr double kMinArea = 1e-2;  ///< that counts as one [m^2]

/// What is wrong with a query, as a result with outcome and reason; nothing when it is
/// fine.
std::optional<CoverageResult> check(const CoverageQuery& query);

/// The same for an area with a swath that gives about kMaxLines / 2 lines or more, as
/// some areas need twice the lines that their width says.
std::optional<CoverageResult> check_lines(const CoverageQuery& query,
                                          const geo::Region& area);

/// The zones that hold at the altitude at some time from the start on.
std::vector<Zone> zones_that_count(const CoverageQuery& query);

/// The area without holes and zones, clean.
geo::Region area_to_cover(const CoverageQuery& query,
                          const std::vector<geo::Ring>& zones);

}  // namespace skein::solve
