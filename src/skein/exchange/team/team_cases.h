// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "skein/base/result.h"
#include "skein/solve/allocation/coalitions.h"
#include "skein/solve/allocation/sequences.h"
#include "skein/solve/touring/tours.h"

namespace skein::exchange {

/// One problem of `skein team allocate`.
struct CoalitionCase {
  std::string id;
  std::vector<std::int64_t> tasks;  ///< their ids
  solve::CoalitionProblem problem;
};

/// One problem of `skein team route`; flight times are those of straight lines.
struct SequenceCase {
  std::string id;
  std::vector<std::int64_t> tasks;  ///< their ids
  solve::SequenceProblem problem;
};

/// One problem of `skein team tours`; costs are straight distances, not rounded.
struct TourCase {
  std::string id;                    ///< SET-TOURS
  std::vector<std::int64_t> places;  ///< their numbers, in the order of the problem
  solve::TourProblem problem;
};

/// Reads a list of problems (JSON): docs/allocation.md has the keys.
///
/// @param place         the file, as messages call it.
/// @param idle_allowed  whether aircraft may stay without a task.
/// Fails: kBadInput with the place of the first problem, what is allowed, and how many
///        more there are: unknown keys, numbers out of range, ids twice or unknown.
Result<std::vector<CoalitionCase>> read_coalition_cases(std::string_view text,
                                                        const std::string& place,
                                                        bool idle_allowed);
Result<std::vector<SequenceCase>> read_sequence_cases(std::string_view text,
                                                      const std::string& place);

/// Reads points (CSV: set,point,x,y) and which tours are asked for (CSV with the columns
/// set and vehicles; others are passed over). Tours begin at the first point of a set.
///
/// Fails: as above; a set without points.
Result<std::vector<TourCase>> read_tour_cases(std::string_view points,
                                              const std::string& points_place,
                                              std::string_view cases,
                                              const std::string& cases_place);
/// The same for all sets of the points, each with every number of tours.
Result<std::vector<TourCase>> read_tour_cases(std::string_view points,
                                              const std::string& points_place,
                                              const std::vector<std::size_t>& tours);

/// Whether the first line of a table has a column of that name.
bool has_column(std::string_view table, std::string_view name);

}  // namespace skein::exchange
