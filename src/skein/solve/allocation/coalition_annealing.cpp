// SPDX-License-Identifier: Apache-2.0
#include "skein/solve/allocation/coalition_annealing.h"

#include <cmath>

#include "skein/base/math.h"
#include "skein/solve/allocation/coalition_groups.h"
#include "skein/solve/allocation/search_random.h"

namespace skein::solve {
namespace {

constexpr std::size_t kNobody = CoalitionAnswer::kIdle;
constexpr double kHottest = 0.5, kColdest = 0.001;
constexpr double kGain = 1e-12;  // less is rounding

// One task of those that there are, or idle where that is allowed.
std::size_t any_task(const CoalitionProblem& problem, SearchRandom& random) {
  const std::size_t k =
      random.below(problem.tasks.size() + (problem.idle_allowed ? 1 : 0));
  return k < problem.tasks.size() ? k : CoalitionAnswer::kIdle;
}

// The places that an aircraft may go to.
std::vector<std::size_t> all_places(const CoalitionProblem& problem) {
  std::vector<std::size_t> places;
  for (std::size_t k = 0; k < problem.tasks.size(); ++k) places.push_back(k);
  if (problem.idle_allowed) places.push_back(CoalitionAnswer::kIdle);
  return places;
}

bool polish_one(CoalitionGroups& groups, const std::vector<std::size_t>& places,
                std::size_t i) {
  const std::size_t from = groups.task_of(i);
  const double left = groups.change(from, i, kNobody);
  for (const std::size_t to : places) {
    if (to == from) continue;
    if (left + groups.change(to, kNobody, i) > kGain) {
      groups.move(i, to);
      return true;
    }
    if (to == CoalitionAnswer::kIdle) continue;
    const std::vector<std::size_t> there = groups.members(to);
    for (const std::size_t other : there) {
      const double taken = groups.change(to, other, i);
      if (taken + groups.change(from, i, other) > kGain) {
        groups.move(i, to);
        groups.move(other, from);
        return true;
      }
      if (left + taken < -1) continue;  // joining never gives that much back
      for (const std::size_t third : places)
        if (third != to && third != from &&
            left + taken + groups.change(third, kNobody, other) > kGain) {
          groups.move(i, to);
          groups.move(other, third);
          return true;
        }
    }
  }
  return false;
}

}  // namespace

void polish_coalitions(const CoalitionProblem& problem, std::vector<std::size_t>& task) {
  CoalitionGroups groups(problem, task);
  const std::vector<std::size_t> places = all_places(problem);
  for (bool better = true; better;) {
    better = false;
    for (std::size_t i = 0; i < problem.aircraft; ++i)
      while (polish_one(groups, places, i)) better = true;
  }
  task = groups.task();
}

std::int64_t anneal_coalitions(const CoalitionProblem& problem, const Effort& effort,
                               std::int64_t moves, std::uint32_t instance,
                               std::vector<std::size_t>& task) {
  SearchRandom random(effort.seed, instance);
  CoalitionGroups groups(problem, task);
  double utility = utility_of(problem, task), most = utility;
  double temperature = kHottest;
  std::int64_t k = 0;
  for (; k < moves; ++k) {
    if (k % 128 == 0) {
      if (effort.ended()) break;
      const double share = static_cast<double>(k) / static_cast<double>(moves);
      temperature = kHottest * math::pow(kColdest / kHottest, share);
    }
    const std::size_t i = random.below(problem.aircraft);
    const std::size_t from = groups.task_of(i);
    const bool swaps = problem.aircraft > 1 && (random.bits() >> 63) != 0;
    const std::size_t other = swaps ? random.below(problem.aircraft) : kNobody;
    const std::size_t to = swaps ? groups.task_of(other) : any_task(problem, random);
    if (to == from) continue;
    const double gain = groups.change(from, i, other) + groups.change(to, other, i);
    if (gain < 0 && !(gain > temperature * math::log(random.uniform()))) continue;
    groups.move(i, to);
    if (swaps) groups.move(other, from);
    utility += gain;
    if (utility > most + kGain) {
      most = utility;
      task = groups.task();
    }
  }
  polish_coalitions(problem, task);
  return k;
}

}  // namespace skein::solve
