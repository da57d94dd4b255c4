// SPDX-License-Identifier: Apache-2.0
#include "skein/solve/allocation/sequence_orders.h"

#include <algorithm>
#include <array>

#include "skein/base/check.h"
#include "skein/base/math.h"

namespace skein::solve {
namespace {

constexpr std::int64_t kMaxOrderNodes = 20'000'000;

class OrderSearch {
 public:
  OrderSearch(const SequenceTable& table, double limit, const Effort& effort)
      : table_(table),
        effort_(effort),
        routes_(table.aircraft),
        free_(table.aircraft, 0),
        begin_(table.tasks, 0),
        done_(table.tasks, false) {
    best_.cost = limit;
    best_.routes.resize(table.aircraft);
    for (std::size_t t = 0; t < table.tasks; ++t)
      if (table.together[t] == t) groups_.push_back(group_of(t));
  }

  OrderedRoutes run() {
    best_.complete = look(0, 0);
    return best_;
  }
  std::int64_t nodes() const { return nodes_; }

 private:
  using Group = std::vector<std::size_t>;

  Group group_of(std::size_t t) const {
    Group group;
    for (std::size_t s = 0; s < table_.tasks; ++s)
      if (table_.together[s] == t) group.push_back(s);
    return group;
  }

  // All continuations with begins from `now` on; false when the budget ended.
  bool look(std::size_t placed, double now) {
    if (++nodes_ > effort_.moves(kMaxOrderNodes) ||
        (nodes_ % 1024 == 0 && effort_.ended()))
      return false;
    if (bound(now) >= best_.cost - 1e-9) return true;
    if (placed == table_.tasks) {
      best_.cost = bound(now);
      best_.routes = routes_;
      best_.found = true;
      return true;
    }
    for (const Group& group : groups_) {
      if (done_[group[0]] || !is_ready(group)) continue;
      if (!place(group, 0, placed, now, ready_at(group))) return false;
    }
    return true;
  }

  bool is_ready(const Group& group) const {
    for (const auto& p : table_.precedences)
      if (!done_[p.before] &&
          std::find(group.begin(), group.end(), p.after) != group.end())
        return false;
    return true;
  }
  double ready_at(const Group& group) const {
    double time = 0;
    for (const std::size_t t : group) time = std::max(time, table_.opens[t]);
    for (const auto& p : table_.precedences)
      if (std::find(group.begin(), group.end(), p.after) != group.end())
        time = std::max(time, begin_[p.before] + table_.service[p.before] + p.gap);
    return time;
  }

  // An aircraft for the k-th task of a group that begins at `begin` or later; none twice.
  bool place(const Group& group, std::size_t k, std::size_t placed, double now,
             double begin) {
    if (k == group.size()) return go_on(group, placed, now, begin);
    const std::size_t t = group[k];
    for (std::size_t a = 0; a < table_.aircraft; ++a) {
      if (!table_.may(a, t) || is_used(k, a)) continue;
      const double arrival = routes_[a].empty()
                                 ? table_.start_of(a, t)
                                 : free_[a] + table_.leg(a, routes_[a].back(), t);
      chosen_[k] = a;
      if (!place(group, k + 1, placed, now, std::max(begin, arrival))) return false;
    }
    return true;
  }
  bool is_used(std::size_t k, std::size_t a) const {
    return std::find(chosen_.begin(), chosen_.begin() + static_cast<std::ptrdiff_t>(k),
                     a) != chosen_.begin() + static_cast<std::ptrdiff_t>(k);
  }

  bool go_on(const Group& group, std::size_t placed, double now, double begin) {
    if (begin < now) return true;  // another order has it
    for (const std::size_t t : group)
      if (begin > table_.closes[t]) return true;
    const std::vector<std::size_t> chosen(
        chosen_.begin(), chosen_.begin() + static_cast<std::ptrdiff_t>(group.size()));
    std::vector<double> free;
    for (std::size_t k = 0; k < group.size(); ++k) {
      free.push_back(free_[chosen[k]]);
      routes_[chosen[k]].push_back(group[k]);
      free_[chosen[k]] = begin + table_.service[group[k]];
      begin_[group[k]] = begin;
      done_[group[k]] = true;
    }
    const bool complete = look(placed + group.size(), begin);
    for (std::size_t k = 0; k < group.size(); ++k) {
      routes_[chosen[k]].pop_back();
      free_[chosen[k]] = free[k];
      done_[group[k]] = false;
      chosen_[k] = chosen[k];  // deeper levels have used it
    }
    return complete;
  }

  // What the routes so far cost, and what is missing at the least.
  double bound(double now) const {
    double last = 0, total = 0, value = 0;
    for (std::size_t a = 0; a < table_.aircraft; ++a) {
      if (routes_[a].empty()) continue;
      const bool whole = std::find(done_.begin(), done_.end(), false) == done_.end();
      const double end = free_[a] + (whole ? table_.home_of(a, routes_[a].back()) : 0.0);
      last = std::max(last, end);
      total += end;
    }
    for (std::size_t t = 0; t < table_.tasks; ++t) {
      const double begin = done_[t] ? begin_[t] : soonest(t, now);
      value += table_.value[t] * math::exp(-table_.discount * begin);
      if (done_[t]) continue;
      last = std::max(last, begin + table_.service[t]);
      total += table_.service[t];
    }
    if (table_.objective == SequenceObjective::kDiscounted) return -value;
    return table_.objective == SequenceObjective::kLastEnd ? last : total;
  }
  // When a task that is not done can begin: nothing begins before `now` any more.
  double soonest(std::size_t t, double now) const {
    return std::max(now, table_.opens[t]);
  }

  const SequenceTable& table_;
  const Effort& effort_;
  SequenceRoutes routes_;
  std::vector<double> free_, begin_;
  std::vector<bool> done_;
  std::vector<Group> groups_;
  std::array<std::size_t, kMaxOrderedTasks> chosen_{};
  OrderedRoutes best_;
  std::int64_t nodes_ = 0;
};

}  // namespace

OrderedRoutes best_by_orders(const SequenceTable& table, double limit,
                             const Effort& effort, std::int64_t& iterations) {
  SKEIN_CHECK(table.tasks <= kMaxOrderedTasks, table.tasks);
  OrderSearch search(table, limit, effort);
  OrderedRoutes best = search.run();
  iterations += search.nodes();
  return best;
}

}  // namespace skein::solve
