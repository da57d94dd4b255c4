// SPDX-License-Identifier: Apache-2.0
#include "skein/solve/coverage/line_order.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "skein/base/random.h"

namespace skein::solve {
namespace {

// Order of `count` neighbours so that steps are k forwards and k - 1 back.
std::vector<int> skipping(int count, int k) {
  std::vector<int> order;
  for (int block = 0; block < count; block += 2 * k)
    for (int i = 0; i < k; ++i)
      for (const int next : {block + i, block + i + k})
        if (next < std::min(count, block + 2 * k)) order.push_back(next);
  return order;
}

// Lines of each cell.
std::vector<std::vector<int>> cells_of(const LineCosts& costs) {
  std::vector<std::vector<int>> cells;
  for (int i = 0; i < costs.lines(); ++i) {
    if (i == 0 || costs.line(2 * i).cell != costs.line(2 * i - 2).cell)
      cells.emplace_back();
    cells.back().push_back(i);
  }
  return cells;
}

double distance(const SweepLine& line, const Vec2& p) {
  return std::min((line.a - p).norm(), (line.b - p).norm());
}

// Lines in the order of a pattern: always the cell whose first or last line is nearest.
std::vector<int> pattern(const LineCosts& costs, std::vector<std::vector<int>> cells,
                         const Vec2& from, bool last_first, int skip) {
  std::vector<int> order;
  Vec2 here = from;
  while (!cells.empty()) {
    std::size_t best = 0;
    bool backwards = last_first;
    double nearest = 1e300;
    for (std::size_t c = 0; c < cells.size(); ++c)
      for (const bool back : {last_first, !last_first}) {
        const int line = back ? cells[c].back() : cells[c].front();
        const double d = distance(costs.line(2 * line), here);
        if (d < nearest) {
          nearest = d;
          best = c;
          backwards = back;
        }
      }
    std::vector<int>& cell = cells[best];
    if (order.empty() && cells.size() == 1) backwards = last_first;
    if (backwards) std::reverse(cell.begin(), cell.end());
    for (const int i : skipping(static_cast<int>(cell.size()), skip))
      order.push_back(cell[index(i)]);
    const SweepLine& last = costs.line(2 * order.back());
    here = (last.a + last.b) / 2;
    cells.erase(cells.begin() + static_cast<std::ptrdiff_t>(best));
  }
  return order;
}

// The best directions for an order of lines.
Route directed(LineCosts& costs, int aircraft, const std::vector<int>& order) {
  std::vector<std::array<int, 2>> came(order.size());
  std::array<double, 2> time{};
  for (std::size_t k = 0; k < order.size(); ++k) {
    std::array<double, 2> next{};
    for (int d = 0; d < 2; ++d) {
      const int to = 2 * order[k] + d;
      if (k == 0) {
        next[index(d)] = costs.cost(costs.start_of(aircraft), to);
        continue;
      }
      const double a = time[0] + costs.cost(2 * order[k - 1], to);
      const double b = time[1] + costs.cost(2 * order[k - 1] + 1, to);
      next[index(d)] = std::min(a, b);
      came[k][index(d)] = b < a ? 1 : 0;
    }
    time = next;
  }
  if (order.empty()) return {};
  const int end = costs.end_of(aircraft);
  const double a = time[0] + costs.cost(2 * order.back(), end);
  const double b = time[1] + costs.cost(2 * order.back() + 1, end);
  int d = b < a ? 1 : 0;
  Route route(order.size());
  for (std::size_t k = order.size(); k-- > 0;) {
    route[k] = 2 * order[k] + d;
    d = came[k][index(d)];
  }
  return route;
}

// One route with the sums that make the effect of a step known at once.
class Improver {
 public:
  Improver(LineCosts& costs, int aircraft, const Route& route) : costs_(costs) {
    nodes_.push_back(costs.start_of(aircraft));
    nodes_.insert(nodes_.end(), route.begin(), route.end());
    nodes_.push_back(costs.end_of(aircraft));
    sum();
  }

  void run() {
    while (!costs_.stopped() && (reverse_some() || move_some())) {
    }
  }

  double time() const { return forth_.back(); }
  Route route() const { return {nodes_.begin() + 1, nodes_.end() - 1}; }

 private:
  std::size_t last() const { return nodes_.size() - 2; }

  void sum() {
    forth_.assign(nodes_.size(), 0);
    back_.assign(nodes_.size(), 0);
    for (std::size_t i = 1; i < nodes_.size(); ++i) {
      forth_[i] = forth_[i - 1] + costs_.cost(nodes_[i - 1], nodes_[i]);
      back_[i] = back_[i - 1];
      if (i > 1 && i <= last()) back_[i] += costs_.cost(nodes_[i] ^ 1, nodes_[i - 1] ^ 1);
    }
  }

  double forth(std::size_t i, std::size_t k) const { return forth_[k] - forth_[i]; }
  double back(std::size_t i, std::size_t k) const { return back_[k] - back_[i]; }

  // Whether the joints from a to b and from c to d are quicker than `max`.
  double joints(int a, int b, int c, int d, double max) {
    const double min = costs_.min_cost(a, b) + costs_.min_cost(c, d);
    if (min >= max) return min;
    return costs_.cost(a, b) + costs_.cost(c, d);
  }

  // Nodes i to k in the other order and direction.
  bool reverse_some() {
    for (std::size_t i = 1; i <= last(); ++i)
      for (std::size_t k = i; k <= last(); ++k) {
        const double max = forth(i - 1, k + 1) - back(i, k) - kGain;
        if (joints(nodes_[i - 1], nodes_[k] ^ 1, nodes_[i] ^ 1, nodes_[k + 1], max) >=
            max)
          continue;
        turn(i, k);
        sum();
        return true;
      }
    return false;
  }

  void turn(std::size_t i, std::size_t k) {
    const auto begin = nodes_.begin() + static_cast<std::ptrdiff_t>(i);
    const auto end = nodes_.begin() + static_cast<std::ptrdiff_t>(k) + 1;
    std::reverse(begin, end);
    for (auto node = begin; node != end; ++node) *node ^= 1;
  }

  // Up to three nodes to another place, in either direction.
  bool move_some() {
    for (std::size_t i = 1; i <= last(); ++i)
      for (std::size_t k = i; k <= std::min(i + 2, last()); ++k) {
        const double bridge = costs_.cost(nodes_[i - 1], nodes_[k + 1]);
        const double gain = forth(i - 1, i) + forth(k, k + 1) - bridge - kGain;
        for (std::size_t p = 0; p <= last(); ++p) {
          if (p + 1 >= i && p <= k) continue;
          const double max = gain + forth(p, p + 1);
          const int from = nodes_[p], to = nodes_[p + 1];
          if (joints(from, nodes_[i], nodes_[k], to, max) < max) {
            move(i, k, p);
            return true;
          }
          const double turned = max - back(i, k) + forth(i, k);
          if (joints(from, nodes_[k] ^ 1, nodes_[i] ^ 1, to, turned) < turned) {
            turn(i, k);
            move(i, k, p);
            return true;
          }
        }
      }
    return false;
  }

  void move(std::size_t i, std::size_t k, std::size_t p) {
    const auto at = [&](std::size_t j) {
      return nodes_.begin() + static_cast<std::ptrdiff_t>(j);
    };
    if (p > k)
      std::rotate(at(i), at(k + 1), at(p + 1));
    else
      std::rotate(at(p + 1), at(i), at(k + 1));
    sum();
  }

  LineCosts& costs_;
  std::vector<int> nodes_;
  std::vector<double> forth_, back_;  // sums of the costs in order, and turned around
};

// Exchanges two neighbouring parts of a route.
Route disturbed(const Route& route, RandomStream& random) {
  const auto n = static_cast<double>(route.size());
  std::array<std::size_t, 3> cut{};
  for (std::size_t& c : cut) c = static_cast<std::size_t>(random.uniform() * (n + 1));
  std::sort(cut.begin(), cut.end());
  Route out = route;
  const auto at = [&](std::size_t k) {
    return out.begin() + static_cast<std::ptrdiff_t>(std::min(cut[k], route.size()));
  };
  std::rotate(at(0), at(1), at(2));
  return out;
}

}  // namespace

double route_time(LineCosts& costs, int aircraft, const Route& route) {
  if (route.empty()) return 0;
  int here = costs.start_of(aircraft);
  double time = 0;
  for (const int visit : route) {
    time += costs.cost(here, visit);
    here = visit;
  }
  return time + costs.cost(here, costs.end_of(aircraft));
}

Route quickest_pattern(LineCosts& costs, int aircraft, int max_skip) {
  const auto cells = cells_of(costs);
  const auto& start = costs.ends(aircraft).start;
  const Vec2 from = start ? start->position : costs.line(0).a;
  Route best;
  double min = 1e300;
  for (int skip = 1; skip <= max_skip; ++skip)
    for (const bool last_first : {false, true}) {
      Route route =
          directed(costs, aircraft, pattern(costs, cells, from, last_first, skip));
      const double time = route_time(costs, aircraft, route);
      if (time < min) {
        min = time;
        best = std::move(route);
      }
    }
  return best;
}

Route improved(LineCosts& costs, int aircraft, Route route, int kicks) {
  if (route.empty()) return route;
  RandomStream random(route.size(), 0, Purpose::kAgent);
  Improver first(costs, aircraft, route);
  first.run();
  double min = first.time();
  route = first.route();
  for (int k = 0; k < kicks && !costs.stopped(); ++k) {
    Improver next(costs, aircraft, disturbed(route, random));
    next.run();
    if (next.time() >= min - kGain) continue;
    min = next.time();
    route = next.route();
  }
  return route;
}

Route order_lines(LineCosts& costs, const OrderBudget& budget) {
  Route route = quickest_pattern(costs, 0, budget.max_skip);
  if (costs.lines() <= budget.exact_up_to) return quickest_order(costs, 0, route);
  return improved(costs, 0, std::move(route), budget.kicks);
}

}  // namespace skein::solve
