// SPDX-License-Identifier: Apache-2.0
#include "skein/solve/allocation/sequence_subsets.h"

#include <algorithm>
#include <bit>

#include "skein/base/check.h"
#include "skein/base/math.h"

namespace skein::solve {
namespace {

using Tasks = std::uint32_t;

// One aircraft's best cost of every subset of tasks, and how to fly it.
class SubsetRoutes {
 public:
  SubsetRoutes(const SequenceTable& table, std::size_t a)
      : table_(table), a_(a), n_(table.tasks), at_(n_ << n_, math::kInfinity) {
    if (table.objective == SequenceObjective::kDiscounted)
      fill_values();
    else
      fill_ends();
  }

  const std::vector<double>& costs() const { return cost_; }

  std::vector<std::size_t> route(Tasks subset) const {
    return table_.objective == SequenceObjective::kDiscounted ? route_of_values(subset)
                                                              : route_of_ends(subset);
  }

 private:
  double& at(Tasks subset, std::size_t t) { return at_[subset * n_ + t]; }
  double at(Tasks subset, std::size_t t) const { return at_[subset * n_ + t]; }
  Tasks allowed() const {
    Tasks all = 0;
    for (std::size_t t = 0; t < n_; ++t)
      if (table_.may(a_, t)) all |= Tasks{1} << t;
    return all;
  }

  // at(S, t): soonest end of S with t the last; infinite where a window has closed.
  double end_by(Tasks rest, std::size_t t) const {
    double arrival = rest == 0 ? table_.start_of(a_, t) : math::kInfinity;
    for (Tasks left = rest; left != 0; left &= left - 1) {
      const auto s = static_cast<std::size_t>(std::countr_zero(left));
      arrival = std::min(arrival, at(rest, s) + table_.leg(a_, s, t));
    }
    const double begin = std::max(arrival, table_.opens[t]);
    return begin <= table_.closes[t] ? begin + table_.service[t] : math::kInfinity;
  }
  void fill_ends() {
    const Tasks may = allowed();
    cost_.assign(std::size_t{1} << n_, math::kInfinity);
    cost_[0] = 0;
    for (Tasks subset = 1; subset < cost_.size(); ++subset) {
      if ((subset & ~may) != 0) continue;
      for (Tasks left = subset; left != 0; left &= left - 1) {
        const auto t = static_cast<std::size_t>(std::countr_zero(left));
        at(subset, t) = end_by(subset ^ (Tasks{1} << t), t);
        cost_[subset] = std::min(cost_[subset], at(subset, t) + table_.home_of(a_, t));
      }
    }
  }
  std::vector<std::size_t> route_of_ends(Tasks subset) const {
    std::vector<std::size_t> route;
    while (subset != 0) {
      std::size_t best = n_;
      double least = math::kInfinity;
      for (std::size_t t = 0; t < n_; ++t) {
        if (!(subset >> t & 1)) continue;
        const double onward =
            route.empty() ? table_.home_of(a_, t) : table_.leg(a_, t, route.back());
        if (best == n_ || at(subset, t) + onward < least) {
          best = t;
          least = at(subset, t) + onward;
        }
      }
      route.push_back(best);
      subset ^= Tasks{1} << best;
    }
    std::reverse(route.begin(), route.end());
    return route;
  }

  // at(S, t): the most that S is worth when work on t, which is not in S, begins now.
  void fill_values() {
    const Tasks may = allowed();
    std::vector<double> fade(n_ * n_);  // of all value while t is done and s reached
    for (std::size_t t = 0; t < n_; ++t)
      for (std::size_t s = 0; s < n_; ++s)
        fade[t * n_ + s] =
            math::exp(-table_.discount * (table_.service[t] + table_.leg(a_, t, s)));
    cost_.assign(std::size_t{1} << n_, math::kInfinity);
    for (Tasks subset = 0; subset < cost_.size(); ++subset) {
      if ((subset & ~may) != 0) continue;
      for (std::size_t t = 0; t < n_; ++t) {
        if (subset >> t & 1) continue;
        double most = 0;
        for (Tasks left = subset; left != 0; left &= left - 1) {
          const auto s = static_cast<std::size_t>(std::countr_zero(left));
          most = std::max(most, fade[t * n_ + s] *
                                    (table_.value[s] + at(subset ^ (Tasks{1} << s), s)));
        }
        at(subset, t) = most;
      }
      cost_[subset] = subset == 0 ? 0 : -first_of(subset).second;
    }
  }
  std::pair<std::size_t, double> first_of(Tasks subset) const {
    std::pair<std::size_t, double> best{n_, 0};
    for (std::size_t s = 0; s < n_; ++s) {
      if (!(subset >> s & 1)) continue;
      const double worth = math::exp(-table_.discount * table_.start_of(a_, s)) *
                           (table_.value[s] + at(subset ^ (Tasks{1} << s), s));
      if (best.first == n_ || worth > best.second) best = {s, worth};
    }
    return best;
  }
  std::vector<std::size_t> route_of_values(Tasks subset) const {
    std::vector<std::size_t> route;
    while (subset != 0) {
      std::size_t next = n_;
      if (route.empty()) {
        next = first_of(subset).first;
      } else {
        double most = -1;
        for (std::size_t s = 0; s < n_; ++s) {
          if (!(subset >> s & 1)) continue;
          const double worth =
              math::exp(-table_.discount * table_.leg(a_, route.back(), s)) *
              (table_.value[s] + at(subset ^ (Tasks{1} << s), s));
          if (worth > most) {
            most = worth;
            next = s;
          }
        }
      }
      route.push_back(next);
      subset ^= Tasks{1} << next;
    }
    return route;
  }

  const SequenceTable& table_;
  std::size_t a_, n_;
  std::vector<double> at_, cost_;
};

// The best sharing of each subset among the aircraft so far and one more.
template <class Join>
void add_aircraft(const std::vector<double>& own, Tasks from, Join join,
                  std::vector<double>& best, std::vector<Tasks>& taken) {
  std::vector<double> next(best.size(), math::kInfinity);
  for (Tasks all = from; all < best.size(); ++all) {
    double least = join(best[all], own[0]);
    Tasks share = 0;
    for (Tasks part = all; part != 0; part = (part - 1) & all) {
      const double cost = join(best[all ^ part], own[part]);
      if (cost < least) {
        least = cost;
        share = part;
      }
    }
    next[all] = least;
    taken[all] = share;
  }
  best = std::move(next);
}

}  // namespace

bool can_be_done_by_subsets(const SequenceTable& table) {
  if (table.tasks > kMaxSubsetTasks || table.is_coupled()) return false;
  return table.objective != SequenceObjective::kDiscounted || !table.has_windows();
}

std::optional<SequenceRoutes> best_by_subsets(const SequenceTable& table,
                                              std::int64_t& iterations) {
  SKEIN_CHECK(can_be_done_by_subsets(table), table.tasks);
  const std::size_t subsets = std::size_t{1} << table.tasks;
  SequenceRoutes routes(table.aircraft);
  if (table.tasks == 0) return routes;
  std::vector<SubsetRoutes> own;
  std::vector<std::vector<Tasks>> taken(table.aircraft);
  std::vector<double> best;
  for (std::size_t a = 0; a < table.aircraft; ++a) {
    own.emplace_back(table, a);
    taken[a].assign(subsets, 0);
    if (a == 0) {
      best = own[a].costs();
      for (Tasks s = 0; s < subsets; ++s) taken[a][s] = s;
      continue;
    }
    // Of the last aircraft only the whole counts.
    const Tasks from = a + 1 == table.aircraft ? static_cast<Tasks>(subsets - 1) : 0;
    if (table.objective == SequenceObjective::kLastEnd)
      add_aircraft(
          own[a].costs(), from, [](double x, double y) { return std::max(x, y); }, best,
          taken[a]);
    else
      add_aircraft(
          own[a].costs(), from, [](double x, double y) { return x + y; }, best, taken[a]);
    iterations += static_cast<std::int64_t>(subsets);
  }
  if (!(best[subsets - 1] < math::kInfinity)) return std::nullopt;
  Tasks left = static_cast<Tasks>(subsets - 1);
  for (std::size_t a = table.aircraft; a-- > 0;) {
    const Tasks share = taken[a][left];
    routes[a] = own[a].route(share);
    left ^= share;
  }
  return routes;
}

}  // namespace skein::solve
