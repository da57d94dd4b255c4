// SPDX-License-Identifier: Apache-2.0
#include "skein/campaign/tuning/simplex_search.h"

#include <algorithm>
#include <cmath>

#include "skein/base/check.h"

namespace skein::campaign {
namespace {

// The point at `centre` + share (centre - from).
std::vector<double> beyond(const std::vector<double>& centre,
                           const std::vector<double>& from, double share) {
  std::vector<double> at(centre.size());
  for (std::size_t i = 0; i < at.size(); ++i)
    at[i] = centre[i] + share * (centre[i] - from[i]);
  return at;
}

class Search {
 public:
  Search(const std::function<std::optional<double>(const std::vector<double>&)>& cost,
         const SimplexOptions& options)
      : cost_(cost), options_(options) {}

  // Nothing when the search is over.
  std::optional<SimplexTry> attempt(const std::vector<double>& at) {
    if (static_cast<int>(result.tries.size()) >= options_.evaluations) return {};
    const auto value = cost_(at);
    if (!value) {
      result.stopped = true;
      return {};
    }
    result.tries.push_back({at, *value});
    if (result.best.at.empty() || *value < result.best.cost)
      result.best = result.tries.back();
    return result.tries.back();
  }

  // Moves the worst corner of the sorted simplex; false when the search is over.
  bool step(std::vector<SimplexTry>& corners) {
    const SimplexTry& worst = corners.back();
    const std::size_t n = worst.at.size();
    std::vector<double> centre(n, 0);
    for (std::size_t k = 0; k + 1 < corners.size(); ++k)
      for (std::size_t i = 0; i < n; ++i)
        centre[i] += corners[k].at[i] / static_cast<double>(n);

    auto mirrored = attempt(beyond(centre, worst.at, 1));
    if (!mirrored) return false;
    if (mirrored->cost < corners.front().cost) {
      auto further = attempt(beyond(centre, worst.at, 2));
      if (!further) return false;
      corners.back() = further->cost < mirrored->cost ? *further : *mirrored;
      return true;
    }
    if (mirrored->cost < corners[n - 1].cost) {
      corners.back() = *mirrored;
      return true;
    }
    const bool outside = mirrored->cost < worst.cost;
    auto nearer = attempt(beyond(centre, worst.at, outside ? 0.5 : -0.5));
    if (!nearer) return false;
    if (nearer->cost < std::min(mirrored->cost, worst.cost)) {
      corners.back() = *nearer;
      return true;
    }
    for (std::size_t k = 1; k < corners.size(); ++k) {
      auto shrunk = attempt(beyond(corners.front().at, corners[k].at, -0.5));
      if (!shrunk) return false;
      corners[k] = *shrunk;
    }
    return true;
  }

  bool small(const std::vector<SimplexTry>& corners) const {
    for (std::size_t k = 1; k < corners.size(); ++k)
      for (std::size_t i = 0; i < corners[k].at.size(); ++i)
        if (std::abs(corners[k].at[i] - corners[0].at[i]) > options_.min) return false;
    return true;
  }

  SimplexResult result;

 private:
  const std::function<std::optional<double>(const std::vector<double>&)>& cost_;
  const SimplexOptions& options_;
};

}  // namespace

SimplexResult simplex_search(
    const std::function<std::optional<double>(const std::vector<double>&)>& cost,
    const std::vector<double>& start, const SimplexOptions& options) {
  SKEIN_CHECK(!start.empty() && options.step != 0, options.step);
  Search search(cost, options);
  std::vector<SimplexTry> corners;
  for (std::size_t k = 0; k <= start.size(); ++k) {
    std::vector<double> at = start;
    if (k > 0) at[k - 1] += options.step;
    auto tried = search.attempt(at);
    if (!tried) return search.result;
    corners.push_back(std::move(*tried));
  }
  const auto cheaper = [](const SimplexTry& a, const SimplexTry& b) {
    return a.cost < b.cost;
  };
  do {
    std::stable_sort(corners.begin(), corners.end(), cheaper);
  } while (!search.small(corners) && search.step(corners));
  return search.result;
}

}  // namespace skein::campaign
