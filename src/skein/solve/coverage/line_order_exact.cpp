// SPDX-License-Identifier: Apache-2.0
#include <cstdint>

#include "skein/base/check.h"
#include "skein/solve/coverage/line_order.h"

namespace skein::solve {

Route quickest_order(LineCosts& costs, int aircraft, const Route& route) {
  const std::size_t n = route.size();
  SKEIN_CHECK(n <= 12, n);
  if (n == 0) return route;
  const std::size_t sets = std::size_t{1} << n;
  const auto visit = [&](std::size_t k) {
    return (route[k / 2] & ~1) + static_cast<int>(k % 2);
  };
  // least[set][k]: quickest through all lines of the set that ends with visit k.
  std::vector<double> min(sets * 2 * n, 1e300);
  std::vector<std::size_t> came(sets * 2 * n, 0);
  for (std::size_t k = 0; k < 2 * n; ++k)
    min[(std::size_t{1} << k / 2) * 2 * n + k] =
        costs.cost(costs.start_of(aircraft), visit(k));
  for (std::size_t set = 1; set < sets; ++set)
    for (std::size_t k = 0; k < 2 * n; ++k) {
      const double so_far = min[set * 2 * n + k];
      if (so_far >= 1e300) continue;
      for (std::size_t j = 0; j < 2 * n; ++j) {
        if ((set >> j / 2 & 1u) != 0) continue;
        const std::size_t next = (set | std::size_t{1} << j / 2) * 2 * n + j;
        const double time = so_far + costs.cost(visit(k), visit(j));
        if (time >= min[next]) continue;
        min[next] = time;
        came[next] = k;
      }
    }
  std::size_t best = 0;
  double time = 1e300;
  for (std::size_t k = 0; k < 2 * n; ++k) {
    const double whole =
        min[(sets - 1) * 2 * n + k] + costs.cost(visit(k), costs.end_of(aircraft));
    if (whole >= time) continue;
    time = whole;
    best = k;
  }
  Route out(n);
  std::size_t set = sets - 1;
  for (std::size_t k = n; k-- > 0;) {
    out[k] = visit(best);
    const std::size_t before = came[set * 2 * n + best];
    set &= ~(std::size_t{1} << best / 2);
    best = before;
  }
  return out;
}

}  // namespace skein::solve
