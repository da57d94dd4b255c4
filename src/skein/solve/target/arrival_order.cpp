// SPDX-License-Identifier: Apache-2.0
#include "skein/solve/target/arrival_order.h"

#include <algorithm>
#include <numeric>

namespace skein::solve {
namespace {

constexpr int kMaxTries = 10;  // of first times that all can meet

// Whether all can meet the times from `first` on; else the next first time to try.
bool all_meet(const std::vector<TimedLeg>& legs, const std::vector<std::size_t>& order,
              double first, double spacing, Arrivals& arrivals, double& next) {
  arrivals.flights.assign(legs.size(), {});
  arrivals.times.assign(legs.size(), 0);
  next = first;
  bool all = true;
  for (std::size_t k = 0; k < order.size(); ++k) {
    const double later = static_cast<double>(k) * spacing;
    TimedFlight& flight = arrivals.flights[order[k]];
    flight = arrive_at(legs[order[k]], first + later);
    arrivals.times[order[k]] = first + later;
    if (flight.status == TimedStatus::kFound) continue;
    all = false;
    next = std::max(next, flight.next - later);
  }
  return all;
}

}  // namespace

Arrivals arrive_in_order(const std::vector<TimedLeg>& legs, std::optional<double> first,
                         double spacing) {
  std::vector<double> earliest;
  for (const TimedLeg& leg : legs) earliest.push_back(earliest_arrival(leg));
  std::vector<std::size_t> order(legs.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return earliest[a] < earliest[b];
  });
  Arrivals arrivals;
  arrivals.earliest = earliest[order[0]];
  for (std::size_t k = 0; k < order.size(); ++k)
    arrivals.earliest = std::max(arrivals.earliest,
                                 earliest[order[k]] - static_cast<double>(k) * spacing);
  double next = 0;
  if (first) {
    if (*first < arrivals.earliest - 1e-9) {
      arrivals.status = TimedStatus::kTooEarly;
      return arrivals;
    }
    if (all_meet(legs, order, *first, spacing, arrivals, next)) {
      arrivals.status = TimedStatus::kFound;
      return arrivals;
    }
  } else {
    next = arrivals.earliest;
  }
  for (int tries = 0; tries < kMaxTries; ++tries) {
    const double time = next;
    if (!all_meet(legs, order, time, spacing, arrivals, next)) continue;
    arrivals.earliest = time;
    arrivals.status = first ? TimedStatus::kGap : TimedStatus::kFound;
    return arrivals;
  }
  arrivals.status = TimedStatus::kGap;
  arrivals.earliest = next;
  return arrivals;
}

}  // namespace skein::solve
