// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/team/onboard/sequence_allocation.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "skein/layer/reasoning/team/onboard/sequence_problem.h"

namespace skein::reasoning {
namespace {

using solve::SequenceRoutes;

constexpr std::int64_t kMoves = 300'000;         // of a search among many tasks
constexpr std::int64_t kTiedMoves = 10'000'000;  // over their number: where they are tied
constexpr std::size_t kFewTasks = 10;            // that are looked at anew each time

// A move costs a look at all tasks where some are tied to others.
std::int64_t moves_of(const TeamSequences& all) {
  if (!all.is_tied()) return kMoves;
  return std::min(kMoves, kTiedMoves / static_cast<std::int64_t>(
                                           std::max<std::size_t>(1, all.tasks())));
}

std::vector<std::size_t> numbers_to(std::size_t count) {
  std::vector<std::size_t> numbers;
  for (std::size_t k = 0; k < count; ++k) numbers.push_back(k);
  return numbers;
}

// Each aircraft's tasks in its quickest order.
void order_each(const TeamSequences& all, SequenceRoutes& routes) {
  for (std::size_t a = 0; a < routes.size(); ++a) {
    if (routes[a].size() < 2 || routes[a].size() > kFewTasks) continue;
    const auto best = best_sequences(all.part(routes[a], {a}), {});
    if (!best || !best.value().feasible) continue;
    std::vector<std::size_t> ordered;
    for (const std::size_t k : best.value().routes.front())
      ordered.push_back(routes[a][k]);
    routes[a] = std::move(ordered);
  }
}

// Few tasks: who ends last keeps its route, and the others share theirs anew, until all
// have theirs: without it, whoever does not end last would fly anything.
void share_rest(const TeamSequences& all, SequenceRoutes& routes) {
  std::vector<std::size_t> aircraft = numbers_to(all.aircraft());
  while (aircraft.size() > 1) {
    SequenceRoutes present(all.aircraft());
    for (const std::size_t a : aircraft) present[a] = routes[a];
    const auto times = all.times(present);
    if (!times) return;
    const auto last = std::ranges::max_element(
        aircraft, {}, [&](std::size_t a) { return times->ends[a]; });
    aircraft.erase(last);
    std::vector<std::size_t> tasks;
    for (const std::size_t a : aircraft)
      tasks.insert(tasks.end(), routes[a].begin(), routes[a].end());
    std::ranges::sort(tasks);
    if (tasks.empty()) return;
    const auto found = best_sequences(all.part(tasks, aircraft), {});
    if (!found || !found.value().feasible) return;
    for (std::size_t k = 0; k < aircraft.size(); ++k) {
      routes[aircraft[k]].clear();
      for (const std::size_t t : found.value().routes[k])
        routes[aircraft[k]].push_back(tasks[t]);
    }
  }
}

// Whether routes are to replace the present ones: the last task ends sooner by enough, or
// no later and all together sooner.
bool is_worth_changing(const TeamSequences::Times& present,
                       const TeamSequences::Times& found) {
  const auto better = [](double before, double now) {  // utilities are negative times
    return solve::is_worth_changing(-before, -now, false);
  };
  return better(present.last(), found.last()) ||
         (found.last() <= present.last() && better(present.total, found.total));
}

// Never better than that all that has been begun ends.
double bound_of(const TeamSequences& all, double bound, double value) {
  for (std::size_t a = 0; a < all.aircraft(); ++a) bound = std::max(bound, all.delay(a));
  return std::min(bound, value);
}

}  // namespace

// With many tasks only when there is something new, or somebody is idle for whom there
// may be work.
bool SequenceAllocation::must_plan(std::span<const TeamTask> open,
                                   std::span<const TeamWorker> workers,
                                   bool is_new) const {
  if (is_new || open.size() <= kFewTasks + workers.size()) return true;
  std::size_t most = 0, least = open.size();
  for (const auto& [id, own] : flown_) {
    const auto left =
        static_cast<std::size_t>(std::ranges::count_if(own, [&](std::uint32_t number) {
          return std::ranges::find(open, number, &TeamTask::number) != open.end();
        }));
    most = std::max(most, left);
    least = std::min(least, left);
  }
  return least == 0 && most > 1;
}

solve::Quality SequenceAllocation::plan(std::span<const TeamTask> open,
                                        std::span<const TeamWorker> workers) {
  const TeamSequences all(open, workers, kMaxPlanned, *conditions_);
  SequenceRoutes routes = all.routes_of(whole_);
  auto present = all.times(routes);
  double bound = 0;
  if (all.tasks() > 0) {
    auto found = best_sequences(all.problem(), {.iterations = moves_of(all)});
    if (found && found.value().feasible) {
      // The search counts when what has no end begins; the utility does not.
      if (!all.has_endless()) bound = found.value().quality.bound;
      SequenceRoutes& better = found.value().routes;
      if (!all.is_tied()) {
        if (all.tasks() <= kFewTasks) share_rest(all, better);
        order_each(all, better);
      }
      const auto times = all.times(better);
      if (times && (!present || whole_.empty() || is_worth_changing(*present, *times))) {
        routes = std::move(better);
        present = times;
      }
    }
  }
  if (!present) {  // nothing can be flown as the plan was
    routes.assign(all.aircraft(), {});
    present = all.times(routes);
  }
  whole_ = all.plan_of(routes);
  flown_ = all.plan_of(all.within_endurance(std::move(routes)));
  solve::Quality quality;
  quality.value = present ? present->last() : 0;
  quality.bound = bound_of(all, bound, quality.value);
  return quality;
}

TeamAllocated SequenceAllocation::operator()(std::span<const TeamTask> open,
                                             std::span<const TeamWorker> workers) {
  std::set<EntityId> ids;
  std::set<std::uint32_t> numbers;
  for (const TeamWorker& worker : workers) ids.insert(worker.id);
  for (const TeamTask& task : open) numbers.insert(task.number);
  const bool is_new = ids != workers_ || !std::ranges::includes(tasks_, numbers);
  workers_ = std::move(ids);
  tasks_ = std::move(numbers);
  std::optional<solve::Quality> quality;
  if (must_plan(open, workers, is_new)) quality = plan(open, workers);
  TeamAllocated all(flown_);
  for (auto& [id, own] : all.given)
    std::erase_if(own, [this](std::uint32_t task) { return !tasks_.contains(task); });
  if (quality) {
    all.value = -quality->value;
    all.bound = -quality->bound;
  }
  return all;
}

}  // namespace skein::reasoning
