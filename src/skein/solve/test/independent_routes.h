// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

// Checks of routes and tours that share no code with the solvers: every way to do the
// tasks is tried.
namespace independent {

enum class Goal { kLastEnd, kSumOfEnds, kDiscountedValue };

struct Work {
  double service = 0, opens = 0, closes = 0, value = 0;
  std::vector<bool> eligible;  // by aircraft
};

/// `first` ends `time` before `second` begins; or both begin at once, by two aircraft.
struct Tie {
  bool at_once = false;
  std::size_t first = 0, second = 0;
  double time = 0;
};

struct Routing {
  std::size_t aircraft = 0;
  std::vector<Work> work;
  std::vector<std::vector<double>> start, home;       // by aircraft, task
  std::vector<std::vector<std::vector<double>>> leg;  // by aircraft, from, to
  std::vector<Tie> ties;
  std::vector<std::size_t> one_of;  // of these tasks one is done; none: all are
  Goal goal = Goal::kLastEnd;
  double discount = 0;
  bool returns = false;
};

/// The best objective over all routes of all aircraft that keep windows and ties, as a
/// cost (of a value: its negative); infinite where there are none. Up to 6 tasks.
long double least_cost(const Routing& problem);

/// The shortest longest tour from place 0 over all other places, by enumeration over
/// subsets of places for each tour. Any costs; up to 12 places.
long double shortest_longest_tour(const std::vector<std::vector<double>>& cost,
                                  std::size_t tours);

}  // namespace independent
