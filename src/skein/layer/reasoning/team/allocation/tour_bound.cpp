#include "skein/layer/reasoning/team/allocation/tour_bound.h"

#include <algorithm>
#include <limits>
#include <vector>

namespace skein::allocation {
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

double one_tour_bound(const TourCosts& costs) {
  const std::uint32_t n = costs.places();
  if (n < 3) return 0;
  std::vector<double> price(n, 0.0);
  std::vector<int> before(n, 0);
  double bound = 0, step = 0;
  for (int k = 0; k < kAscents; ++k) {
    const OneTree tree = min_one_tree(costs, price);
    double cost = tree.cost;
    for (const double p : price) cost -= 2 * p;
    bound = std::max(bound, cost);
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

}  // namespace

double tour_bound(const TourCosts& costs, std::size_t tours) {
  double bound = 0;
  for (std::uint32_t a = 1; a < costs.places(); ++a)
    bound = std::max(bound, costs(0, a) + costs(a, 0));
  if (costs.is_symmetric() && costs.is_metric())
    bound = std::max(bound, one_tour_bound(costs) / static_cast<double>(tours));
  return bound;
}

}  // namespace skein::allocation
