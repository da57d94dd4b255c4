// SPDX-License-Identifier: Apache-2.0
#include "skein/solve/allocation/sequence_schedule.h"

#include <algorithm>
#include <numeric>

#include "skein/base/math.h"

namespace skein::solve {
namespace {

// One pass over all routes; whether any task begins later than before.
bool pass_over(const SequenceTable& table, const SequenceRoutes& routes,
               const std::vector<double>& earliest, SequenceSchedule& schedule) {
  bool later = false;
  for (std::size_t a = 0; a < routes.size(); ++a) {
    double free = 0;
    for (std::size_t k = 0; k < routes[a].size(); ++k) {
      const std::size_t t = routes[a][k];
      const double arrival =
          k == 0 ? table.start_of(a, t) : free + table.leg(a, routes[a][k - 1], t);
      const double begin = std::max({arrival, table.opens[t], earliest[t]});
      if (begin > schedule.begin[t]) {
        schedule.begin[t] = begin;
        later = true;
      }
      free = schedule.begin[t] + table.service[t];
    }
    schedule.end[a] = routes[a].empty() ? 0 : free + table.home_of(a, routes[a].back());
  }
  return later;
}

// What relations add after a pass; whether anything.
bool pass_on(const SequenceTable& table, const SequenceSchedule& schedule,
             std::vector<double>& earliest) {
  bool later = false;
  const auto raise = [&](std::size_t t, double to) {
    if (to <= earliest[t]) return;
    earliest[t] = to;
    later = later || to > schedule.begin[t];
  };
  for (const auto& p : table.precedences)
    raise(p.after, schedule.begin[p.before] + table.service[p.before] + p.gap);
  for (std::size_t t = 0; t < table.tasks; ++t)
    raise(table.together[t], schedule.begin[t]);
  for (std::size_t t = 0; t < table.tasks; ++t)
    raise(t, std::max(earliest[table.together[t]], schedule.begin[table.together[t]]));
  return later;
}

// Tasks that begin together are done by different aircraft, also where both take no time.
bool has_one_for_two(const SequenceTable& table, const SequenceRoutes& routes) {
  for (const auto& route : routes)
    for (std::size_t k = 1; k < route.size(); ++k)
      for (std::size_t j = 0; j < k; ++j)
        if (table.together[route[j]] == table.together[route[k]]) return true;
  return false;
}

}  // namespace

SequenceSchedule schedule_of(const SequenceTable& table, const SequenceRoutes& routes) {
  SequenceSchedule schedule;
  schedule.begin.assign(table.tasks, 0);
  schedule.end.assign(table.aircraft, 0);
  std::vector<double> earliest(table.tasks, 0);
  const bool coupled = table.is_coupled();
  if (coupled && has_one_for_two(table, routes)) {
    schedule.late = math::kInfinity;
    return schedule;
  }
  // Each pass settles at least one more task, unless they wait for each other.
  for (std::size_t pass = 0;; ++pass) {
    pass_over(table, routes, earliest, schedule);
    if (!coupled || !pass_on(table, schedule, earliest)) break;
    if (pass > 2 * table.tasks) {
      schedule.late = math::kInfinity;
      return schedule;
    }
  }
  for (std::size_t t = 0; t < table.tasks; ++t)
    schedule.late += std::max(0.0, schedule.begin[t] - table.closes[t]);
  return schedule;
}

double cost_of(const SequenceTable& table, const SequenceSchedule& schedule) {
  switch (table.objective) {
    case SequenceObjective::kLastEnd:
      return schedule.end.empty()
                 ? 0
                 : *std::max_element(schedule.end.begin(), schedule.end.end());
    case SequenceObjective::kTotal:
      return std::accumulate(schedule.end.begin(), schedule.end.end(), 0.0);
    case SequenceObjective::kDiscounted:
      break;
  }
  double value = 0;
  for (std::size_t t = 0; t < table.tasks; ++t)
    value += table.value[t] * math::exp(-table.discount * schedule.begin[t]);
  return -value;
}

double cost_bound(const SequenceTable& table) {
  double alone = 0, work = 0, value = 0;
  for (std::size_t t = 0; t < table.tasks; ++t) {
    double soonest = math::kInfinity, reach = math::kInfinity;
    for (std::size_t a = 0; a < table.aircraft; ++a) {
      if (!table.may(a, t)) continue;
      // Over other tasks it may be nearer than straight from the start, if times are odd.
      double from = table.start_of(a, t);
      for (std::size_t s = 0; s < table.tasks; ++s)
        if (s != t && table.may(a, s)) from = std::min(from, table.leg(a, s, t));
      reach = std::min(reach, from);
      double first = table.start_of(a, t);
      for (std::size_t s = 0; s < table.tasks; ++s)
        if (s != t && table.may(a, s))
          first = std::min(first, table.start_of(a, s) + table.service[s] + from);
      soonest = std::min(soonest, first);
    }
    const double begin = std::max(soonest, table.opens[t]);
    // Where it is not the last task, others follow before the way home: none counts.
    alone = std::max(alone, begin + table.service[t]);
    work += reach + table.service[t];
    value += table.value[t] * math::exp(-table.discount * begin);
  }
  if (table.objective == SequenceObjective::kDiscounted) return -value;
  if (table.objective == SequenceObjective::kTotal) return work;
  return std::max(alone, table.aircraft ? work / static_cast<double>(table.aircraft) : 0);
}

}  // namespace skein::solve
