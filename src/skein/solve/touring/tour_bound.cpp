// SPDX-License-Identifier: Apache-2.0
#include "skein/solve/touring/tour_bound.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace skein::solve {
namespace {

constexpr int kAscents = 300;

// A least tree over all places but 0, and the two cheapest edges of place 0.
struct OneTree {
  double cost = 0;  // with prices
  std::vector<int> degree;
};

OneTree min_one_tree(const TourCosts& costs, const std::vector<double>& price) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  const std::uint32_t n = costs.places();
  OneTree tree;
  tree.degree.assign(n, 0);
  std::vector<double> nearest(n, kFar);
  std::vector<std::uint32_t> through(n, 1);
  std::vector<bool> in(n, false);
  const auto priced = [&](std::uint32_t a, std::uint32_t b) {
    return costs(a, b) + price[a] + price[b];
  };
  std::uint32_t last = 1;
  in[1] = true;
  for (std::uint32_t step = 2; step < n; ++step) {
    std::uint32_t next = 0;
    for (std::uint32_t b = 2; b < n; ++b) {
      if (in[b]) continue;
      const double cost = priced(last, b);
      if (cost < nearest[b]) {
        nearest[b] = cost;
        through[b] = last;
      }
      if (next == 0 || nearest[b] < nearest[next]) next = b;
    }
    in[next] = true;
    tree.cost += nearest[next];
    ++tree.degree[next];
    ++tree.degree[through[next]];
    last = next;
  }
  std::uint32_t first = 0, second = 0;
  for (std::uint32_t b = 1; b < n; ++b) {
    if (first == 0 || priced(0, b) < priced(0, first)) {
      second = first;
      first = b;
    } else if (second == 0 || priced(0, b) < priced(0, second)) {
      second = b;
    }
  }
  for (const std::uint32_t b : {first, second}) {
    tree.cost += priced(0, b);
    ++tree.degree[0];
    ++tree.degree[b];
  }
  return tree;
}

// What rounding may have added to a sum of so many numbers of such a size.
double rounding_of(double size, std::size_t numbers) {
  return std::numeric_limits<double>::epsilon() * static_cast<double>(numbers) * size;
}

double one_tour_bound(const TourCosts& costs) {
  const std::uint32_t n = costs.places();
  if (n < 3) return 0;
  std::vector<double> price(n, 0.0);
  std::vector<int> before(n, 0);
  double bound = 0, step = 0;
  for (int k = 0; k < kAscents; ++k) {
    const OneTree tree = min_one_tree(costs, price);
    double cost = tree.cost, prices = 0;
    for (std::uint32_t a = 0; a < n; ++a) {
      cost -= 2 * price[a];
      prices += (tree.degree[a] + 2) * std::abs(price[a]);
    }
    bound = std::max(bound,
                     cost - rounding_of(std::abs(cost) + 2 * prices, std::size_t{4} * n));
    if (k == 0) step = cost / (2.0 * n);
    bool is_tour = true;
    for (std::uint32_t a = 0; a < n; ++a) {
      const int wrong = tree.degree[a] - 2;
      is_tour = is_tour && wrong == 0;
      price[a] += step * (0.7 * wrong + 0.3 * before[a]);
      before[a] = wrong;
    }
    if (is_tour) break;
    step *= 0.98;
  }
  return bound;
}

// The least cost from place 0 to every place, or from every place to it, over any others.
std::vector<double> least_costs(const TourCosts& costs, bool to_depot) {
  const std::uint32_t n = costs.places();
  std::vector<double> least(n, std::numeric_limits<double>::infinity());
  std::vector<bool> settled(n, false);
  least[0] = 0;
  for (std::uint32_t round = 0; round < n; ++round) {
    std::uint32_t nearest = n;
    for (std::uint32_t a = 0; a < n; ++a)
      if (!settled[a] && (nearest == n || least[a] < least[nearest])) nearest = a;
    settled[nearest] = true;
    for (std::uint32_t b = 0; b < n; ++b) {
      if (settled[b]) continue;
      const double leg = to_depot ? costs(b, nearest) : costs(nearest, b);
      least[b] = std::min(least[b], least[nearest] + leg);
    }
  }
  return least;
}

}  // namespace

double tour_bound(const TourCosts& costs, std::size_t tours) {
  double bound = 0;
  // Over other places it may be nearer than straight.
  const std::vector<double> there = least_costs(costs, false);
  const std::vector<double> back = least_costs(costs, true);
  for (std::uint32_t a = 1; a < costs.places(); ++a)
    bound = std::max(bound, there[a] + back[a]);
  bound -= rounding_of(bound, costs.places());
  if (costs.is_symmetric() && costs.is_metric())
    bound = std::max(bound, one_tour_bound(costs) / static_cast<double>(tours) *
                                (1 - TourCosts::kMetricTolerance));
  return bound;
}

}  // namespace skein::solve
