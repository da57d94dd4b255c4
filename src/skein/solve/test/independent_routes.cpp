// SPDX-License-Identifier: Apache-2.0
#include "skein/solve/test/independent_routes.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace independent {
namespace {

using Length = long double;
constexpr Length kNone = std::numeric_limits<Length>::infinity();

// Puts tasks one by one at every place of every route, and rates each whole answer.
class AllRoutes {
 public:
  explicit AllRoutes(const Routing& problem)
      : problem_(problem), routes_(problem.aircraft), begin_(problem.work.size()) {}

  Length least() {
    if (problem_.one_of.empty()) {
      done_.assign(problem_.work.size(), true);
      place(0);
    }
    for (const std::size_t chosen : problem_.one_of) {
      done_.assign(problem_.work.size(), true);
      for (const std::size_t t : problem_.one_of) done_[t] = t == chosen;
      place(0);
    }
    return least_;
  }

 private:
  void place(std::size_t t) {
    if (t == problem_.work.size()) return rate();
    if (!done_[t]) return place(t + 1);
    for (std::size_t a = 0; a < problem_.aircraft; ++a) {
      if (!problem_.work[t].eligible[a]) continue;
      auto& route = routes_[a];
      for (std::size_t k = 0; k <= route.size(); ++k) {
        route.insert(route.begin() + static_cast<std::ptrdiff_t>(k), t);
        place(t + 1);
        route.erase(route.begin() + static_cast<std::ptrdiff_t>(k));
      }
    }
  }

  bool delay(std::size_t t, Length to) {
    if (to <= begin_[t]) return false;
    begin_[t] = to;
    return true;
  }

  bool same_route(std::size_t s, std::size_t t) const {
    return std::any_of(routes_.begin(), routes_.end(), [&](const auto& route) {
      return std::find(route.begin(), route.end(), s) != route.end() &&
             std::find(route.begin(), route.end(), t) != route.end();
    });
  }

  // Begins are delayed until nothing has to be; who waits for itself never ends.
  bool settle() {
    for (std::size_t t = 0; t < begin_.size(); ++t) begin_[t] = problem_.work[t].opens;
    for (std::size_t pass = 0; pass < 4 * begin_.size() + 4; ++pass) {
      bool later = false;
      for (std::size_t a = 0; a < routes_.size(); ++a)
        for (std::size_t k = 0; k < routes_[a].size(); ++k) {
          const std::size_t t = routes_[a][k];
          const Length there =
              k == 0 ? Length(problem_.start[a][t])
                     : end_of(routes_[a][k - 1]) + problem_.leg[a][routes_[a][k - 1]][t];
          later = delay(t, there) || later;
        }
      for (const Tie& tie : problem_.ties) {
        if (!done_[tie.first] || !done_[tie.second]) continue;
        if (tie.at_once) {
          later = delay(tie.first, begin_[tie.second]) || later;
          later = delay(tie.second, begin_[tie.first]) || later;
        } else {
          later = delay(tie.second, end_of(tie.first) + tie.time) || later;
        }
      }
      if (!later) return true;
    }
    return false;
  }
  Length end_of(std::size_t t) const { return begin_[t] + problem_.work[t].service; }

  void rate() {
    for (const Tie& tie : problem_.ties)
      if (tie.at_once && done_[tie.first] && done_[tie.second] &&
          same_route(tie.first, tie.second))
        return;
    if (!settle()) return;
    Length last = 0, sum = 0, value = 0;
    for (std::size_t t = 0; t < begin_.size(); ++t) {
      if (!done_[t]) continue;
      // Sums of the same numbers in another order may differ in the last digits.
      if (begin_[t] > problem_.work[t].closes + 1e-9L) return;
      value += problem_.work[t].value * std::exp(-problem_.discount * begin_[t]);
    }
    for (std::size_t a = 0; a < routes_.size(); ++a) {
      if (routes_[a].empty()) continue;
      const std::size_t t = routes_[a].back();
      const Length end = end_of(t) + (problem_.returns ? problem_.home[a][t] : 0);
      last = std::max(last, end);
      sum += end;
    }
    const Length cost = problem_.goal == Goal::kLastEnd     ? last
                        : problem_.goal == Goal::kSumOfEnds ? sum
                                                            : -value;
    least_ = std::min(least_, cost);
  }

  const Routing& problem_;
  std::vector<std::vector<std::size_t>> routes_;
  std::vector<Length> begin_;
  std::vector<bool> done_;
  Length least_ = kNone;
};

}  // namespace

long double least_cost(const Routing& problem) {
  return AllRoutes(problem).least();
}

long double shortest_longest_tour(const std::vector<std::vector<double>>& cost,
                                  std::size_t tours) {
  const std::size_t n = cost.size() - 1, sets = std::size_t{1} << n;
  // The shortest flight from place 0 over a set, by the place where it ends.
  std::vector<std::vector<Length>> over(sets, std::vector<Length>(n, kNone));
  std::vector<Length> closed(sets, kNone);
  closed[0] = 0;
  for (std::size_t set = 1; set < sets; ++set)
    for (std::size_t last = 0; last < n; ++last) {
      if (((set >> last) & 1) == 0) continue;
      const std::size_t before = set ^ (std::size_t{1} << last);
      Length& best = over[set][last];
      if (before == 0) best = cost[0][last + 1];
      for (std::size_t from = 0; from < n; ++from)
        if (((before >> from) & 1) != 0)
          best = std::min(best, over[before][from] + cost[from + 1][last + 1]);
      closed[set] = std::min(closed[set], best + cost[last + 1][0]);
    }
  std::vector<Length> longest = closed;
  for (std::size_t tour = 1; tour < tours; ++tour) {
    std::vector<Length> next = longest;
    for (std::size_t set = 0; set < sets; ++set)
      for (std::size_t part = set; part != 0; part = (part - 1) & set)
        next[set] = std::min(next[set], std::max(longest[set ^ part], closed[part]));
    longest = std::move(next);
  }
  return longest[sets - 1];
}

}  // namespace independent
