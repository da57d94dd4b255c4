#include "skein/layer/reasoning/team/onboard/sequence_allocation.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "skein/base/math.h"
#include "skein/layer/reasoning/team/allocation/sequence_schedule.h"
#include "skein/layer/reasoning/team/allocation/sequences.h"
#include "skein/layer/reasoning/team/onboard/task_needs.h"

namespace skein::reasoning {
namespace {

using allocation::SequenceProblem;
using allocation::SequenceRoutes;
using allocation::SequenceTask;

constexpr std::int64_t kMoves = 300'000;  // of a search among many tasks
constexpr std::int64_t kTiedMoves = 10'000'000;  // over their number: where they are tied
constexpr std::size_t kFewTasks = 14;     // that are always looked at anew
constexpr std::size_t kFewTied = 8;       // the same, with relations
constexpr double kFar = 1e7;              // what cannot be flown to [s]

// A task that nobody has begun.
struct Job {
  const TeamTask* task;
  TaskNeeds needs;
  double opens = 0;  // what it comes after is being flown so long [s]
};

// An aircraft, and where and when it is free.
struct Flyer {
  EntityId id;
  TeamResources free;                     // after what it has begun
  double delay = 0;                       // until then [s]
  std::optional<std::uint32_t> begun = {};
};

// What is to be shared: numbers of jobs and flyers are those of the problem.
struct Sharing {
  std::vector<Job> jobs;
  std::vector<Flyer> flyers;
  SequenceProblem problem;
  std::vector<std::vector<double>> within;  // by flyer and job [s]
};

const TeamTask* find(std::span<const TeamTask> tasks, std::uint32_t number) {
  const auto found = std::ranges::find(tasks, number, &TeamTask::number);
  return found == tasks.end() ? nullptr : &*found;
}

Flyer flyer_of(const TeamWorker& worker, std::span<const TeamTask> tasks,
               std::set<std::uint32_t>& begun, const FlightConditions& conditions) {
  Flyer flyer{worker.id, worker.resources};
  for (std::size_t k = 0; k < worker.tasks.size(); ++k) {
    const TeamTask* task = find(tasks, worker.tasks[k]);
    const double share = k < worker.shares.size() ? worker.shares[k] : 0;
    if (!task || share <= 0 || begun.contains(task->number)) continue;
    TaskNeeds left = needs_of(*task);
    if (left.end || left.begin) {
      const Vec2 end = left.end.value_or(*left.begin);
      flyer.free.place.x() = end.x();
      flyer.free.place.y() = end.y();
    }
    left.length *= 1 - share;
    left.stay *= 1 - share;
    flyer.delay = time_within(left, worker.resources, conditions).value_or(0);
    flyer.free.endurance -= kEnduranceReserve * flyer.delay;
    flyer.begun = task->number;
    begun.insert(task->number);
    break;
  }
  return flyer;
}

// Whether an aircraft may fly a task as its next one.
bool may_fly(const Flyer& flyer, const Job& job, const FlightConditions& conditions) {
  if ((job.task->sensors & ~flyer.free.sensors) != 0) return false;
  const auto approach = time_to_begin(job.needs, flyer.free, conditions);
  const auto within = time_within(job.needs, flyer.free, conditions);
  const auto home = time_home(job.needs, flyer.free, conditions);
  if (!approach || !within || !home) return false;
  return job.needs.endless ||
         kEnduranceReserve * (*approach + *within + *home) <= flyer.free.endurance;
}

// Tasks that can be planned: of which somebody is able, and what they come after too.
void choose_jobs(std::span<const TeamTask> tasks, const std::set<std::uint32_t>& begun,
                 Sharing& sharing, const FlightConditions& conditions) {
  std::map<std::uint32_t, double> ends;  // of what has been begun [s]
  for (const Flyer& flyer : sharing.flyers)
    if (flyer.begun) ends[*flyer.begun] = flyer.delay;
  for (const TeamTask& task : tasks) {
    if (begun.contains(task.number)) continue;
    Job job{&task, needs_of(task)};
    for (const std::uint32_t before : task.after)
      if (const auto end = ends.find(before); end != ends.end())
        job.opens = std::max(job.opens, end->second);
    const bool is_able = std::ranges::any_of(
        sharing.flyers, [&](const Flyer& f) { return may_fly(f, job, conditions); });
    if (is_able) sharing.jobs.push_back(std::move(job));
  }
  // What comes after a task that nobody flies is not flown either.
  const auto waits_for_ever = [&](const Job& job) {
    return std::ranges::any_of(job.task->after, [&](std::uint32_t before) {
      return !ends.contains(before) &&
             std::ranges::none_of(sharing.jobs, [&](const Job& other) {
               return other.task->number == before;
             });
    });
  };
  for (std::size_t count = 0; count != sharing.jobs.size();) {
    count = sharing.jobs.size();
    const auto gone = std::ranges::find_if(sharing.jobs, waits_for_ever);
    if (gone != sharing.jobs.end()) sharing.jobs.erase(gone);
  }
}

double seconds(const std::optional<double>& time) {
  return std::min(time.value_or(kFar), kFar);
}

void tie(Sharing& sharing) {
  for (std::size_t k = 0; k < sharing.jobs.size(); ++k)
    for (const std::uint32_t before : sharing.jobs[k].task->after)
      for (std::size_t j = 0; j < sharing.jobs.size(); ++j)
        if (sharing.jobs[j].task->number == before)
          sharing.problem.relations.push_back(
              {allocation::TaskRelation::Kind::kBefore, j, k, 0});
}

// The problem refers to the sharing, which must stay where it is.
void make_problem(Sharing& sharing, const FlightConditions& conditions) {
  SequenceProblem& problem = sharing.problem;
  problem.aircraft = sharing.flyers.size();
  sharing.within.resize(problem.aircraft);
  for (std::size_t a = 0; a < problem.aircraft; ++a)
    for (const Job& job : sharing.jobs)
      sharing.within[a].push_back(
          seconds(time_within(job.needs, sharing.flyers[a].free, conditions)));
  for (std::size_t k = 0; k < sharing.jobs.size(); ++k) {
    SequenceTask& task = problem.tasks.emplace_back();
    task.opens = sharing.jobs[k].opens;
    task.service = kFar;
    for (std::size_t a = 0; a < problem.aircraft; ++a) {
      task.eligible.push_back(may_fly(sharing.flyers[a], sharing.jobs[k], conditions));
      if (task.eligible.back())
        task.service = std::min(task.service, sharing.within[a][k]);
    }
  }
  tie(sharing);
  problem.from_start = [&sharing, &conditions](std::size_t a, std::size_t k) {
    const Flyer& flyer = sharing.flyers[a];
    return flyer.delay +
           seconds(time_to_begin(sharing.jobs[k].needs, flyer.free, conditions));
  };
  // Who is slower than the quickest of a task needs the rest of its time after it.
  problem.between = [&sharing, &conditions](std::size_t a, std::size_t from,
                                            std::size_t to) {
    const double more = std::max(
        0.0, sharing.within[a][from] - sharing.problem.tasks[from].service);
    const TaskNeeds &ends = sharing.jobs[from].needs, &begins = sharing.jobs[to].needs;
    if (!begins.begin || !(ends.end || ends.begin)) return more;
    const Vec2 end = ends.end ? *ends.end : *ends.begin;
    return more +
           seconds(conditions.time(end, *begins.begin, sharing.flyers[a].free.speed));
  };
}

// Each aircraft's tasks in its quickest order, where no task waits for another one.
void order_each(const Sharing& sharing, SequenceRoutes& routes) {
  if (!sharing.problem.relations.empty()) return;
  for (std::size_t a = 0; a < routes.size(); ++a) {
    const std::vector<std::size_t> own = routes[a];
    if (own.size() < 2 || own.size() > kFewTasks) continue;
    SequenceProblem alone;
    alone.aircraft = 1;
    for (const std::size_t k : own) {
      alone.tasks.push_back(sharing.problem.tasks[k]);
      alone.tasks.back().eligible.clear();
    }
    alone.from_start = [&](std::size_t, std::size_t k) {
      return sharing.problem.from_start(a, own[k]);
    };
    alone.between = [&](std::size_t, std::size_t from, std::size_t to) {
      return sharing.problem.between(a, own[from], own[to]);
    };
    const auto best = best_sequences(alone, {});
    if (!best || !best.value().feasible) continue;
    for (std::size_t k = 0; k < own.size(); ++k)
      routes[a][k] = own[best.value().routes.front()[k]];
  }
}

// As much of a route as the endurance allows.
void cut_to_endurance(const Sharing& sharing, std::size_t a,
                      std::vector<std::size_t>& route,
                      const FlightConditions& conditions) {
  const Flyer& flyer = sharing.flyers[a];
  double flown = 0;
  for (std::size_t k = 0; k < route.size(); ++k) {
    const TaskNeeds& needs = sharing.jobs[route[k]].needs;
    flown += k == 0 ? sharing.problem.from_start(a, route[0]) - flyer.delay
                    : sharing.problem.between(a, route[k - 1], route[k]);
    flown += sharing.problem.tasks[route[k]].service;
    const double home = seconds(time_home(needs, flyer.free, conditions));
    if (needs.endless || kEnduranceReserve * (flown + home) <= flyer.free.endurance)
      continue;
    route.resize(std::max<std::size_t>(k, 1));
    return;
  }
}

TeamAllocation plan_of(const Sharing& sharing, const SequenceRoutes& routes) {
  TeamAllocation plan;
  for (std::size_t a = 0; a < sharing.flyers.size(); ++a) {
    auto& own = plan[sharing.flyers[a].id];
    if (sharing.flyers[a].begun) own.push_back(*sharing.flyers[a].begun);
    if (a >= routes.size()) continue;
    for (const std::size_t k : routes[a]) own.push_back(sharing.jobs[k].task->number);
  }
  return plan;
}

// A plan as routes through the jobs that there are now; none: it lacks some of them, or
// gives one to who may not fly it.
std::optional<SequenceRoutes> routes_of(const Sharing& sharing,
                                        const TeamAllocation& plan) {
  SequenceRoutes routes(sharing.flyers.size());
  std::size_t count = 0;
  for (std::size_t a = 0; a < routes.size(); ++a) {
    const auto own = plan.find(sharing.flyers[a].id);
    if (own == plan.end()) continue;
    for (const std::uint32_t number : own->second)
      for (std::size_t k = 0; k < sharing.jobs.size(); ++k) {
        if (sharing.jobs[k].task->number != number) continue;
        if (!sharing.problem.tasks[k].eligible[a]) return std::nullopt;
        routes[a].push_back(k);
        ++count;
      }
  }
  if (count != sharing.jobs.size()) return std::nullopt;
  return routes;
}

// How good some routes are; none: they are not feasible.
std::optional<allocation::Quality> quality_of(const SequenceProblem& problem,
                                              const SequenceRoutes& routes) {
  const auto selections = allocation::SequenceSelections::of(problem);
  if (!selections) return std::nullopt;
  const auto table = selections.value().table(0);
  const auto schedule = schedule_of(table, routes);
  if (schedule.late > 0) return std::nullopt;
  allocation::Quality quality;
  quality.value = cost_of(table, schedule);
  quality.bound = std::min(cost_bound(table), quality.value);
  return quality;
}

bool are_few(const SequenceProblem& problem) {
  return problem.tasks.size() <= (problem.relations.empty() ? kFewTasks : kFewTied);
}

// A move costs a look at all tasks where some are tied to others.
std::int64_t moves_of(const SequenceProblem& problem) {
  if (problem.relations.empty()) return kMoves;
  return std::min(kMoves, kTiedMoves / static_cast<std::int64_t>(problem.tasks.size()));
}

// What can be flown of a plan now: what waits only for tasks that the same aircraft flies
// before it can.
TeamAllocation given_of(const TeamAllocation& plan, std::span<const TeamTask> tasks) {
  TeamAllocation all;
  for (const auto& [id, own] : plan) {
    std::vector<std::uint32_t>& given = all[id];
    for (const std::uint32_t number : own) {
      const TeamTask* task = find(tasks, number);
      if (!task) continue;
      const bool ready = std::ranges::all_of(task->after, [&](std::uint32_t before) {
        return std::ranges::find(given, before) != given.end();
      });
      if (!ready || given.size() >= SequenceAllocation::kMaxGiven) break;
      given.push_back(number);
    }
  }
  return all;
}

}  // namespace

SequenceAllocation::Plan SequenceAllocation::plan(std::span<const TeamTask> open,
                                                  std::span<const TeamWorker> workers,
                                                  bool is_new) const {
  Sharing sharing;
  std::set<std::uint32_t> begun;
  for (const TeamWorker& worker : workers)
    sharing.flyers.push_back(flyer_of(worker, open, begun, *conditions_));
  choose_jobs(open, begun, sharing, *conditions_);
  make_problem(sharing, *conditions_);
  SequenceRoutes routes(sharing.flyers.size());
  allocation::Quality quality;
  for (const Flyer& flyer : sharing.flyers)
    quality.value = quality.bound = std::max(quality.value, flyer.delay);
  if (!sharing.jobs.empty()) {
    const auto kept = is_new ? std::nullopt : routes_of(sharing, whole_);
    const auto present = kept ? quality_of(sharing.problem, *kept) : std::nullopt;
    if (present) {
      routes = *kept;
      quality = *present;
    }
    if (!present || are_few(sharing.problem)) {
      auto found = best_sequences(sharing.problem, {.iterations = moves_of(sharing.problem)});
      // Utilities are negative times.
      const bool is_better =
          found && found.value().feasible &&
          (!present || allocation::is_worth_changing(
                           -present->value, -found.value().quality.value, false));
      if (is_better) {
        routes = std::move(found.value().routes);
        quality = found.value().quality;
        order_each(sharing, routes);
      } else if (found && found.value().feasible) {
        quality.bound = std::max(quality.bound, found.value().quality.bound);
      }
    }
  }
  Plan plan{plan_of(sharing, routes), {}, quality};
  for (std::size_t a = 0; a < routes.size(); ++a)
    cut_to_endurance(sharing, a, routes[a], *conditions_);
  plan.flown = plan_of(sharing, routes);
  return plan;
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
  Plan made = plan(open, workers, is_new);
  whole_ = std::move(made.whole);
  TeamAllocated all(given_of(made.flown, open));
  all.value = -made.quality.value;
  all.bound = -made.quality.bound;
  return all;
}

}  // namespace skein::reasoning
