// SPDX-License-Identifier: Apache-2.0
#include "skein/solve/allocation/sequence_annealing.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "skein/base/math.h"
#include "skein/solve/allocation/search_random.h"

namespace skein::solve {
namespace {

constexpr double kHotShare = 0.05, kColdShare = 1e-5;  // of the cost at the start
constexpr double kMeanWeight = 0.02;                   // of the mean end beside the last
constexpr double kLatePrice = 50;                      // of a second too late, in seconds
constexpr std::size_t kMaxPart = 3;
constexpr double kMinGain = 1e-9;
constexpr double kNever = 1e15;  // cost of tasks that wait for each other without end

// What one route costs when no other matters.
struct RouteCost {
  double end = 0, late = 0, value = 0;
};

// Annealing over routes; costs of routes are kept, and only those that change are
// computed anew unless relations tie them.
class SequenceSearch {
 public:
  SequenceSearch(const SequenceTable& table, std::uint64_t seed)
      : table_(table),
        random_(seed, 1000),
        coupled_(table.is_coupled()),
        routes_(table.aircraft),
        costs_(table.aircraft) {
    for (std::size_t i = 0; i < table.aircraft * table.tasks; ++i)
      fade_start_.push_back(fade(table.start[i]));
    if (table.objective == SequenceObjective::kDiscounted)
      for (std::size_t a = 0; a < table.aircraft; ++a)
        for (std::size_t from = 0; from < table.tasks; ++from)
          for (std::size_t to = 0; to < table.tasks; ++to)
            fade_.push_back(fade(table.service[from] + table.leg(a, from, to)));
    windows_ = table.has_windows();
    begin_greedily();
    if (coupled_ && schedule_of(table_, routes_).late == math::kInfinity)
      begin_in_order();
  }

  std::int64_t run(const Effort& effort, std::int64_t moves) {
    double cost = cost_now();
    keep(cost);
    const double scale = std::max(1e-9, std::abs(cost < kNever ? cost : cost_apart()));
    double temperature = 0;
    std::int64_t k = 0;
    for (; k < moves && table_.tasks > 0; ++k) {
      if (k % 256 == 0) {
        const double time = effort.share_used();
        if (time >= 1) break;
        const double share =
            std::max(time, static_cast<double>(k) / static_cast<double>(moves));
        temperature = kHotShare * scale * math::pow(kColdShare / kHotShare, share);
      }
      if (!change()) continue;
      const double found = cost_now();
      if (found < cost || found < cost - temperature * math::log(random_.uniform())) {
        cost = found;
        if (cost < best_cost_ - kMinGain) keep(cost);
      } else {
        undo();
      }
    }
    return k;
  }

  const SequenceRoutes& best() const { return best_; }

 private:
  double fade(double time) const { return math::exp(-table_.discount * time); }

  RouteCost cost_of_route(std::size_t a) const {
    RouteCost cost;
    const auto& route = routes_[a];
    if (route.empty()) return cost;
    if (table_.objective == SequenceObjective::kDiscounted && !windows_) {
      double faded = fade_start_[a * table_.tasks + route[0]];
      cost.value = faded * table_.value[route[0]];
      for (std::size_t k = 1; k < route.size(); ++k) {
        faded *= fade_[(a * table_.tasks + route[k - 1]) * table_.tasks + route[k]];
        cost.value += faded * table_.value[route[k]];
      }
      return cost;
    }
    for (std::size_t k = 0; k < route.size(); ++k) {
      const std::size_t t = route[k];
      const double arrival =
          k == 0 ? table_.start_of(a, t) : cost.end + table_.leg(a, route[k - 1], t);
      const double begin = std::max(arrival, table_.opens[t]);
      cost.late += std::max(0.0, begin - table_.closes[t]);
      if (table_.objective == SequenceObjective::kDiscounted)
        cost.value += table_.value[t] * fade(begin);
      cost.end = begin + table_.service[t];
    }
    cost.end += table_.home_of(a, route.back());
    return cost;
  }

  double joint_cost(double last, double total, double value, double late) const {
    const double aircraft = static_cast<double>(table_.aircraft);
    switch (table_.objective) {
      case SequenceObjective::kLastEnd:
        return last + kMeanWeight * total / aircraft + kLatePrice * late;
      case SequenceObjective::kTotal:
        return total + kLatePrice * late;
      case SequenceObjective::kDiscounted:
        break;
    }
    return -value + late * late_value_;
  }

  double cost_now() const {
    if (coupled_) {
      double last = 0, total = 0, value = 0;
      const SequenceSchedule schedule = schedule_of(table_, routes_);
      if (schedule.late == math::kInfinity) return kNever;
      for (const double end : schedule.end) {
        last = std::max(last, end);
        total += end;
      }
      if (table_.objective == SequenceObjective::kDiscounted)
        value = -cost_of(table_, schedule);
      return joint_cost(last, total, value, schedule.late);
    }
    return cost_apart();
  }

  // As if no relations tied the routes.
  double cost_apart() const {
    double last = 0, total = 0, value = 0, late = 0;
    for (const RouteCost& cost : costs_) {
      last = std::max(last, cost.end);
      total += cost.end;
      value += cost.value;
      late += cost.late;
    }
    return joint_cost(last, total, value, late);
  }

  void keep(double cost) {
    best_cost_ = cost;
    best_ = routes_;
  }

  // Each task, the most valuable first, where it costs least.
  void begin_greedily() {
    std::vector<std::size_t> order(table_.tasks);
    for (std::size_t t = 0; t < order.size(); ++t) order[t] = t;
    std::stable_sort(order.begin(), order.end(), [&](std::size_t s, std::size_t t) {
      return table_.value[s] > table_.value[t];
    });
    for (std::size_t t = 0; t < table_.tasks; ++t) late_value_ += table_.value[t];
    for (const std::size_t t : order) {
      double least = math::kInfinity;
      std::size_t where = 0, at = 0;
      for (std::size_t a = 0; a < table_.aircraft; ++a) {
        if (!table_.may(a, t)) continue;
        const RouteCost before = costs_[a];
        for (std::size_t k = 0; k <= routes_[a].size(); ++k) {
          routes_[a].insert(routes_[a].begin() + static_cast<std::ptrdiff_t>(k), t);
          costs_[a] = cost_of_route(a);
          const double cost = cost_apart();
          if (cost < least) {
            least = cost;
            where = a;
            at = k;
          }
          routes_[a].erase(routes_[a].begin() + static_cast<std::ptrdiff_t>(k));
        }
        costs_[a] = before;
      }
      routes_[where].insert(routes_[where].begin() + static_cast<std::ptrdiff_t>(at), t);
      costs_[where] = cost_of_route(where);
    }
  }

  // Each task behind all that it comes after, at the end of the route that ends first
  // with it: so no two wait for each other without end.
  void begin_in_order() {
    for (std::size_t a = 0; a < table_.aircraft; ++a) {
      routes_[a].clear();
      costs_[a] = {};
    }
    std::vector<std::size_t> waits(table_.tasks, 0);
    for (const auto& p : table_.precedences) ++waits[p.after];
    std::vector<bool> placed(table_.tasks, false);
    const auto is_free = [&](std::size_t t) {
      for (std::size_t s = 0; s < table_.tasks; ++s)
        if (table_.together[s] == table_.together[t] && waits[s] > 0) return false;
      return !placed[t];
    };
    for (std::size_t next = 0; next < table_.tasks; ++next) {
      if (!is_free(next)) continue;
      std::vector<bool> taken(table_.aircraft, false);  // by one that begins with it
      for (std::size_t t = 0; t < table_.tasks; ++t) {
        if (table_.together[t] != table_.together[next]) continue;
        append(t, taken);
        placed[t] = true;
        for (const auto& p : table_.precedences)
          if (p.before == t) --waits[p.after];
      }
      next = std::numeric_limits<std::size_t>::max();  // the first that is free now
    }
    std::vector<bool> taken(table_.aircraft, false);
    for (std::size_t t = 0; t < table_.tasks; ++t)
      if (!placed[t]) append(t, taken);  // relations that nothing can keep
  }

  void append(std::size_t t, std::vector<bool>& taken) {
    std::optional<std::size_t> best;
    double least = math::kInfinity;
    for (std::size_t a = 0; a < table_.aircraft; ++a) {
      if (!table_.may(a, t) || (best && taken[a] && !taken[*best])) continue;
      const double end =
          costs_[a].end + (routes_[a].empty() ? table_.start_of(a, t)
                                              : table_.leg(a, routes_[a].back(), t));
      if (best && taken[a] == taken[*best] && end >= least) continue;
      best = a;
      least = end;
    }
    routes_[*best].push_back(t);
    costs_[*best] = cost_of_route(*best);
    taken[*best] = true;
  }

  // Changes one or two routes; false when there was nothing to change.
  bool change() {
    first_ = random_.below(table_.aircraft);
    second_ = random_.below(table_.aircraft);
    if (routes_[first_].empty()) return false;
    old_first_ = routes_[first_];
    old_second_ = routes_[second_];
    old_cost_first_ = costs_[first_];
    old_cost_second_ = costs_[second_];
    bool changed = false;
    switch (random_.below(4)) {
      case 0:
        changed = move_part();
        break;
      case 1:
        changed = swap_tasks();
        break;
      case 2:
        changed = turn_part();
        break;
      default:
        changed = first_ == second_ ? move_part() : swap_tails();
    }
    if (!changed || !is_eligible(first_) || !is_eligible(second_)) {
      undo();
      return false;
    }
    if (!coupled_) {
      costs_[first_] = cost_of_route(first_);
      if (second_ != first_) costs_[second_] = cost_of_route(second_);
    }
    return true;
  }

  bool is_eligible(std::size_t a) const {
    return std::all_of(routes_[a].begin(), routes_[a].end(),
                       [&](std::size_t t) { return table_.may(a, t); });
  }

  void undo() {
    routes_[first_] = old_first_;
    routes_[second_] = old_second_;
    costs_[first_] = old_cost_first_;
    costs_[second_] = old_cost_second_;
  }

  bool move_part() {
    auto& from = routes_[first_];
    const std::size_t at = random_.below(from.size());
    const std::size_t length = 1 + random_.below(std::min(kMaxPart, from.size() - at));
    const auto begin = from.begin() + static_cast<std::ptrdiff_t>(at);
    std::vector<std::size_t> part(begin, begin + static_cast<std::ptrdiff_t>(length));
    from.erase(begin, begin + static_cast<std::ptrdiff_t>(length));
    if (length > 1 && (random_.bits() >> 63) != 0) std::reverse(part.begin(), part.end());
    auto& to = routes_[second_];
    const auto where =
        to.begin() + static_cast<std::ptrdiff_t>(random_.below(to.size() + 1));
    to.insert(where, part.begin(), part.end());
    return true;
  }
  bool swap_tasks() {
    if (routes_[second_].empty()) return false;
    auto& one = routes_[first_][random_.below(routes_[first_].size())];
    auto& other = routes_[second_][random_.below(routes_[second_].size())];
    std::swap(one, other);
    return one != other;
  }
  bool turn_part() {
    auto& route = routes_[first_];
    if (route.size() < 2) return false;
    const std::size_t i = random_.below(route.size()), j = random_.below(route.size());
    if (i == j) return false;
    std::reverse(route.begin() + static_cast<std::ptrdiff_t>(std::min(i, j)),
                 route.begin() + static_cast<std::ptrdiff_t>(std::max(i, j)) + 1);
    return true;
  }
  bool swap_tails() {
    auto &a = routes_[first_], &b = routes_[second_];
    const auto i = static_cast<std::ptrdiff_t>(random_.below(a.size() + 1));
    const auto j = static_cast<std::ptrdiff_t>(random_.below(b.size() + 1));
    std::vector<std::size_t> tail(a.begin() + i, a.end());
    a.erase(a.begin() + i, a.end());
    a.insert(a.end(), b.begin() + j, b.end());
    b.erase(b.begin() + j, b.end());
    b.insert(b.end(), tail.begin(), tail.end());
    return true;
  }

  const SequenceTable& table_;
  SearchRandom random_;
  bool coupled_, windows_ = false;
  SequenceRoutes routes_, best_;
  std::vector<RouteCost> costs_;
  std::vector<double> fade_start_, fade_;
  double late_value_ = 0, best_cost_ = math::kInfinity;
  // The change that may be undone.
  std::size_t first_ = 0, second_ = 0;
  std::vector<std::size_t> old_first_, old_second_;
  RouteCost old_cost_first_, old_cost_second_;
};

}  // namespace

SequenceRoutes anneal_sequences(const SequenceTable& table, const Effort& effort,
                                std::int64_t moves, std::int64_t& made) {
  SequenceSearch search(table, effort.seed);
  made += search.run(effort, moves);
  return search.best();
}

}  // namespace skein::solve
