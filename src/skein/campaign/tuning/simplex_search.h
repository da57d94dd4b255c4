// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <vector>

namespace skein::campaign {

struct SimplexOptions {
  double step = 0.3;     ///< from the start to the other corners of the first simplex
  int evaluations = 60;  ///< maximum
  double min = 0.01;     ///< ends when the simplex is smaller along each axis
};

/// One point that was tried.
struct SimplexTry {
  std::vector<double> at;
  double cost = 0;
};

struct SimplexResult {
  SimplexTry best;                ///< of all tried; without a point when there is none
  std::vector<SimplexTry> tries;  ///< all, in order; the first is the start
  bool stopped = false;           ///< `cost` gave nothing
};

/// Looks for a minimum without derivatives: the downhill simplex with reflection,
/// expansion, contraction and shrinking (factors 1, 2, 1/2, 1/2). Deterministic.
///
/// @param cost   of a point; none ends the search.
/// @param start  of at least one dimension; tried first.
/// Valid:    finds a nearby minimum of a smooth function of up to ten or so variables.
/// Reference: [Nelder65].
SimplexResult simplex_search(
    const std::function<std::optional<double>(const std::vector<double>&)>& cost,
    const std::vector<double>& start, const SimplexOptions& options);

}  // namespace skein::campaign
