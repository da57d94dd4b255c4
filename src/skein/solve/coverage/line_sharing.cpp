// SPDX-License-Identifier: Apache-2.0
#include "skein/solve/coverage/line_sharing.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace skein::solve {
namespace {

constexpr int kMaxRounds = 400;   // of moves between routes
constexpr int kPermutedUpTo = 4;  // aircraft for which all assignments are tried

using Routes = std::vector<Route>;

struct Division {
  Routes routes;
  double longest = 1e300;
};

// Cuts `whole` into consecutive parts, the k-th for aircraft order[k].
Division cut(LineCosts& costs, const Route& whole, const std::vector<int>& order) {
  const std::size_t n = whole.size(), parts = order.size();
  std::vector<double> forth(n, 0);
  for (std::size_t i = 1; i < n; ++i)
    forth[i] = forth[i - 1] + costs.cost(whole[i - 1], whole[i]);
  // Of visits i to j - 1.
  const auto time = [&](int aircraft, std::size_t i, std::size_t j) {
    if (i == j) return 0.0;
    return costs.cost(costs.start_of(aircraft), whole[i]) + forth[j - 1] - forth[i] +
           costs.cost(whole[j - 1], costs.end_of(aircraft));
  };
  // least[k][j]: the shortest longest part, of the first k, with the first j visits.
  std::vector<std::vector<double>> min(parts + 1, std::vector<double>(n + 1, 1e300));
  std::vector<std::vector<std::size_t>> begin(parts + 1,
                                              std::vector<std::size_t>(n + 1, 0));
  min[0][0] = 0;
  for (std::size_t k = 1; k <= parts; ++k)
    for (std::size_t j = 0; j <= n; ++j)
      for (std::size_t i = 0; i <= j; ++i) {
        if (min[k - 1][i] >= min[k][j]) continue;
        const double t = std::max(min[k - 1][i], time(order[k - 1], i, j));
        if (t >= min[k][j]) continue;
        min[k][j] = t;
        begin[k][j] = i;
      }
  Division d;
  d.longest = min[parts][n];
  d.routes.resize(parts);
  std::size_t j = n;
  for (std::size_t k = parts; k > 0; --k) {
    const std::size_t i = begin[k][j];
    d.routes[index(order[k - 1])].assign(whole.begin() + static_cast<std::ptrdiff_t>(i),
                                         whole.begin() + static_cast<std::ptrdiff_t>(j));
    j = i;
  }
  return d;
}

Division best_cut(LineCosts& costs, const Route& whole) {
  std::vector<int> order(index(costs.aircraft()));
  std::iota(order.begin(), order.end(), 0);
  Division best = cut(costs, whole, order);
  if (costs.aircraft() > kPermutedUpTo || costs.lines() > 200) return best;
  while (std::next_permutation(order.begin(), order.end())) {
    Division next = cut(costs, whole, order);
    if (next.longest < best.longest) best = std::move(next);
  }
  return best;
}

// Betters the longest route at the cost of another one.
class Balancer {
 public:
  Balancer(LineCosts& costs, Routes routes) : costs_(costs), routes_(std::move(routes)) {
    for (int a = 0; a < costs_.aircraft(); ++a)
      times_.push_back(time(a, routes_[index(a)]));
  }

  Routes run() {
    for (int round = 0; round < kMaxRounds && !costs_.stopped(); ++round)
      if (!step()) break;
    return std::move(routes_);
  }

 private:
  double time(int aircraft, const Route& route) {
    return route_time(costs_, aircraft, route);
  }

  bool step() {
    const int longest =
        static_cast<int>(std::max_element(times_.begin(), times_.end()) - times_.begin());
    for (int other = 0; other < costs_.aircraft(); ++other) {
      if (other == longest) continue;
      if (give(longest, other) || exchange_ends(longest, other)) return true;
    }
    return false;
  }

  // Takes two new routes when the longer one is shorter than the longest was.
  bool take(int a, Route ra, int b, Route rb) {
    double ta = time(a, ra), tb = time(b, rb);
    if (std::max(ta, tb) >= times_[index(a)] - kGain) return false;
    ra = improved(costs_, a, std::move(ra), 0);
    rb = improved(costs_, b, std::move(rb), 0);
    times_[index(a)] = time(a, ra);
    times_[index(b)] = time(b, rb);
    routes_[index(a)] = std::move(ra);
    routes_[index(b)] = std::move(rb);
    return true;
  }

  // Up to three visits of `from` into `to`.
  bool give(int from, int to) {
    const Route& giver = routes_[index(from)];
    const Route& taker = routes_[index(to)];
    for (std::size_t i = 0; i < giver.size(); ++i)
      for (std::size_t k = i; k < std::min(i + 3, giver.size()); ++k) {
        const auto first = giver.begin() + static_cast<std::ptrdiff_t>(i);
        const auto past = giver.begin() + static_cast<std::ptrdiff_t>(k) + 1;
        Route rest(giver.begin(), first);
        rest.insert(rest.end(), past, giver.end());
        if (time(from, rest) >= times_[index(from)] - kGain) continue;
        for (const bool turned : {false, true}) {
          Route part(first, past);
          if (turned) {
            std::reverse(part.begin(), part.end());
            for (int& visit : part) visit ^= 1;
          }
          const Place place = cheapest_place(to, taker, part);
          if (times_[index(to)] + place.more >= times_[index(from)] - kGain) continue;
          Route more = taker;
          more.insert(more.begin() + static_cast<std::ptrdiff_t>(place.at), part.begin(),
                      part.end());
          if (take(from, rest, to, std::move(more))) return true;
        }
      }
    return false;
  }

  struct Place {
    std::size_t at = 0;
    double more = 1e300;  // time for the whole route [s]
  };

  Place cheapest_place(int aircraft, const Route& route, const Route& part) {
    Place best;
    double inside = 0;
    for (std::size_t k = 1; k < part.size(); ++k)
      inside += costs_.cost(part[k - 1], part[k]);
    for (std::size_t p = 0; p <= route.size(); ++p) {
      const int before = p == 0 ? costs_.start_of(aircraft) : route[p - 1];
      const int after = p == route.size() ? costs_.end_of(aircraft) : route[p];
      // An empty route takes no time, not that from its start to its end.
      const double now = route.empty() ? 0 : costs_.cost(before, after);
      const double min = costs_.min_cost(before, part.front()) +
                         costs_.min_cost(part.back(), after) + inside - now;
      if (min >= best.more) continue;
      const double more = costs_.cost(before, part.front()) +
                          costs_.cost(part.back(), after) + inside - now;
      if (more < best.more) best = {p, more};
    }
    return best;
  }

  // Time from the aircraft's start through the first k visits of a route, for all k.
  std::vector<double> until(int aircraft, const Route& route) {
    std::vector<double> sums(route.size() + 1, 0);
    int here = costs_.start_of(aircraft);
    for (std::size_t k = 0; k < route.size(); ++k) {
      sums[k + 1] = sums[k] + costs_.cost(here, route[k]);
      here = route[k];
    }
    return sums;
  }

  // Time of the first i visits of one route followed by those of another from j on.
  double crossed(int aircraft, const Route& one, const std::vector<double>& of_one,
                 std::size_t i, const Route& two, const std::vector<double>& of_two,
                 std::size_t j) {
    const bool goes_over = j < two.size();
    if (i == 0 && !goes_over) return 0;
    const int end = costs_.end_of(aircraft);
    const int leaves = i == 0 ? costs_.start_of(aircraft) : one[i - 1];
    if (!goes_over) return of_one[i] + costs_.cost(leaves, end);
    return of_one[i] + costs_.cost(leaves, two[j]) + of_two.back() - of_two[j + 1] +
           costs_.cost(two.back(), end);
  }

  bool exchange_ends(int a, int b) {
    const Route ra = routes_[index(a)], rb = routes_[index(b)];
    const std::vector<double> of_a = until(a, ra), of_b = until(b, rb);
    const double max = times_[index(a)] - kGain;
    for (std::size_t i = 0; i <= ra.size(); ++i)
      for (std::size_t j = 0; j <= rb.size(); ++j) {
        if (crossed(a, ra, of_a, i, rb, of_b, j) >= max ||
            crossed(b, rb, of_b, j, ra, of_a, i) >= max)
          continue;
        const auto ia = ra.begin() + static_cast<std::ptrdiff_t>(i);
        const auto jb = rb.begin() + static_cast<std::ptrdiff_t>(j);
        Route na(ra.begin(), ia), nb(rb.begin(), jb);
        na.insert(na.end(), jb, rb.end());
        nb.insert(nb.end(), ia, ra.end());
        if (take(a, std::move(na), b, std::move(nb))) return true;
      }
    return false;
  }

  LineCosts& costs_;
  Routes routes_;
  std::vector<double> times_;
};

}  // namespace

double rough_longest(LineCosts& costs, const OrderBudget& budget, bool improve) {
  Route whole = quickest_pattern(costs, 0, budget.max_skip);
  const bool one = costs.aircraft() == 1;
  if (improve && one && costs.lines() <= 8)
    whole = quickest_order(costs, 0, whole);
  else if (improve)
    whole = improved(costs, 0, std::move(whole), 0);
  return one ? route_time(costs, 0, whole) : best_cut(costs, whole).longest;
}

std::vector<Route> share_lines(LineCosts& costs, const OrderBudget& budget) {
  if (costs.lines() == 0) return Routes(index(costs.aircraft()));
  if (costs.aircraft() == 1) return {order_lines(costs, budget)};
  const Route whole =
      improved(costs, 0, quickest_pattern(costs, 0, budget.max_skip), budget.kicks / 4);
  Routes routes = best_cut(costs, whole).routes;
  for (int a = 0; a < costs.aircraft(); ++a)
    routes[index(a)] = improved(costs, a, std::move(routes[index(a)]), budget.kicks);
  return Balancer(costs, std::move(routes)).run();
}

}  // namespace skein::solve
