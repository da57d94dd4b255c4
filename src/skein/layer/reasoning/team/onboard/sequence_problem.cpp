// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/team/onboard/sequence_problem.h"

#include <algorithm>
#include <utility>

#include "skein/base/math.h"

namespace skein::reasoning {
namespace {

using solve::SequenceProblem;
using solve::SequenceRoutes;
using solve::SequenceTask;
using solve::TaskRelation;

constexpr double kMaxDelay = 1e5;  // of what has been begun [s]

const TeamTask* find(std::span<const TeamTask> tasks, std::uint32_t number) {
  const auto found = std::ranges::find(tasks, number, &TeamTask::number);
  return found == tasks.end() ? nullptr : &*found;
}

double seconds(const std::optional<double>& time) {
  return std::min(time.value_or(TeamSequences::kNever), TeamSequences::kNever);
}

std::optional<Vec2> end_place(const TaskNeeds& needs) {
  return needs.end ? needs.end : needs.begin;
}

}  // namespace

TeamSequences::TeamSequences(std::span<const TeamTask> tasks,
                             std::span<const TeamWorker> workers, std::size_t max_tasks,
                             const FlightConditions& conditions)
    : conditions_(conditions) {
  std::set<std::uint32_t> begun;
  for (const TeamWorker& worker : workers)
    flyers_.push_back(flyer_of(worker, tasks, begun));
  choose_jobs(tasks, begun, max_tasks);
  make_problem();
}

TeamSequences::Flyer TeamSequences::flyer_of(const TeamWorker& worker,
                                             std::span<const TeamTask> tasks,
                                             std::set<std::uint32_t>& begun) const {
  Flyer flyer{worker.id, worker.resources};
  for (std::size_t k = 0; k < worker.tasks.size(); ++k) {
    const TeamTask* task = find(tasks, worker.tasks[k]);
    const double share = k < worker.shares.size() ? worker.shares[k] : 0;
    if (!task || share <= 0 || begun.contains(task->number)) continue;
    if (!may_be_given(*task, worker.resources)) continue;
    TaskNeeds left = needs_of(*task);
    // The share of what is a flight to a place alone is that of the way.
    const bool is_way = left.length <= 0 && left.stay <= 0;
    left.length *= 1 - share;
    left.stay *= 1 - share;
    const auto time = is_way ? time_to_begin(left, worker.resources, conditions_)
                             : time_within(left, worker.resources, conditions_);
    if (const auto end = end_place(left)) flyer.free.place.head<2>() = *end;
    flyer.delay = std::min(seconds(time), kMaxDelay);
    flyer.free.endurance -= static_cast<float>(kEnduranceReserve * flyer.delay);
    flyer.begun = task->number;
    begun.insert(task->number);
    break;
  }
  return flyer;
}

bool TeamSequences::may_fly(const Flyer& flyer, const Job& job) const {
  if (!may_be_given(*job.task, flyer.free)) return false;
  const auto approach = time_to_begin(job.needs, flyer.free, conditions_);
  const auto within = time_within(job.needs, flyer.free, conditions_);
  const auto home = time_home(job.needs, flyer.free, conditions_);
  if (!approach || !within || !home) return false;
  return job.needs.endless ||
         kEnduranceReserve * (*approach + *within + *home) <= flyer.free.endurance;
}

// Those of which somebody is able, and what they come after too; so none come after
// themselves.
void TeamSequences::choose_jobs(std::span<const TeamTask> tasks,
                                const std::set<std::uint32_t>& begun,
                                std::size_t max_tasks) {
  std::map<std::uint32_t, double> ends;  // of what has been begun [s]
  for (const Flyer& flyer : flyers_)
    if (flyer.begun) ends[*flyer.begun] = flyer.delay;
  std::set<std::uint32_t> planned;
  std::set<std::uint32_t> passed_over;
  std::size_t endless = 0;  // no more than there are aircraft
  for (bool is_more = true; is_more;) {
    is_more = false;
    for (const TeamTask& task : tasks) {
      if (jobs_.size() >= max_tasks) return;
      if (begun.contains(task.number) || planned.contains(task.number) ||
          passed_over.contains(task.number))
        continue;
      const bool is_ready = std::ranges::all_of(task.after, [&](std::uint32_t before) {
        return ends.contains(before) || planned.contains(before);
      });
      if (!is_ready) continue;
      Job job{&task, needs_of(task)};
      for (const std::uint32_t before : task.after)
        if (const auto end = ends.find(before); end != ends.end())
          job.opens = std::max(job.opens, end->second);
      const bool is_able = std::ranges::any_of(
          flyers_, [&](const Flyer& flyer) { return may_fly(flyer, job); });
      const bool is_left = job.needs.endless && endless >= flyers_.size();
      (is_able && !is_left ? planned : passed_over).insert(task.number);
      if (is_able && !is_left) {
        if (job.needs.endless) ++endless;
        jobs_.push_back(std::move(job));
      }
      is_more = true;
    }
  }
}

bool TeamSequences::has_endless() const {
  return std::ranges::any_of(jobs_, [](const Job& job) { return job.needs.endless; });
}

double TeamSequences::start(std::size_t aircraft, std::size_t job) const {
  const Flyer& flyer = flyers_[aircraft];
  return flyer.delay + seconds(time_to_begin(jobs_[job].needs, flyer.free, conditions_));
}

double TeamSequences::leg(std::size_t aircraft, std::size_t from, std::size_t to) const {
  // Nothing comes after what has no end.
  if (jobs_[from].needs.endless) return kNever;
  const double speed = flyers_[aircraft].free.speed;
  std::vector<double>& legs = legs_[speed];
  if (legs.empty()) legs.assign(jobs_.size() * jobs_.size(), -1);
  double& leg = legs[from * jobs_.size() + to];
  if (leg >= 0) return leg;
  const auto end = end_place(jobs_[from].needs);
  const auto& begin = jobs_[to].needs.begin;
  leg = end && begin ? seconds(conditions_.time(*end, *begin, speed)) : 0;
  return leg;
}

void TeamSequences::make_problem() {
  problem_.aircraft = flyers_.size();
  for (const Flyer& flyer : flyers_)
    for (const Job& job : jobs_)
      within_.push_back(job.needs.endless
                            ? 0
                            : seconds(time_within(job.needs, flyer.free, conditions_)));
  std::map<std::uint32_t, std::size_t> places;
  for (std::size_t k = 0; k < jobs_.size(); ++k) {
    SequenceTask& task = problem_.tasks.emplace_back();
    task.opens = jobs_[k].opens;
    task.service = kNever;
    for (std::size_t a = 0; a < flyers_.size(); ++a) {
      task.eligible.push_back(may_fly(flyers_[a], jobs_[k]));
      if (task.eligible.back()) task.service = std::min(task.service, within(a, k));
    }
    for (const std::uint32_t before : jobs_[k].task->after)
      if (const auto place = places.find(before); place != places.end())
        problem_.relations.push_back({TaskRelation::Kind::kBefore, place->second, k, 0});
    places.emplace(jobs_[k].task->number, k);
  }
  // Who is slower than the quickest of a task needs the rest of its time after it.
  const auto rest = [this](std::size_t a, std::size_t k) {
    return std::max(0.0, within(a, k) - problem_.tasks[k].service);
  };
  problem_.from_start = [this](std::size_t a, std::size_t k) { return start(a, k); };
  problem_.between = [this, rest](std::size_t a, std::size_t from, std::size_t to) {
    return std::min(kNever, rest(a, from) + leg(a, from, to));
  };
  problem_.home = rest;
  problem_.returns = true;
}

SequenceProblem TeamSequences::part(const std::vector<std::size_t>& tasks,
                                    const std::vector<std::size_t>& aircraft) const {
  SequenceProblem part;
  part.aircraft = aircraft.size();
  for (const std::size_t k : tasks) {
    SequenceTask& task = part.tasks.emplace_back(problem_.tasks[k]);
    task.eligible.clear();
    for (const std::size_t a : aircraft)
      task.eligible.push_back(problem_.tasks[k].eligible[a]);
  }
  part.from_start = [this, tasks, aircraft](std::size_t a, std::size_t k) {
    return problem_.from_start(aircraft[a], tasks[k]);
  };
  part.between = [this, tasks, aircraft](std::size_t a, std::size_t from,
                                         std::size_t to) {
    return problem_.between(aircraft[a], tasks[from], tasks[to]);
  };
  part.home = [this, tasks, aircraft](std::size_t a, std::size_t k) {
    return problem_.home(aircraft[a], tasks[k]);
  };
  part.returns = true;
  return part;
}

// Without what it waits for.
double TeamSequences::end_of(std::size_t aircraft,
                             const std::vector<std::size_t>& route) const {
  double end = delay(aircraft);
  for (std::size_t k = 0; k < route.size(); ++k) {
    const double arrival =
        k == 0 ? start(aircraft, route[0]) : end + leg(aircraft, route[k - 1], route[k]);
    end = std::max(arrival, jobs_[route[k]].opens) + within(aircraft, route[k]);
  }
  return end;
}

double TeamSequences::Times::last() const {
  return ends.empty() ? 0 : *std::ranges::max_element(ends);
}

std::optional<TeamSequences::Times> TeamSequences::times(
    const SequenceRoutes& routes) const {
  std::vector<double> earliest(jobs_.size(), 0), done(jobs_.size(), 0);
  Times times;
  times.ends.resize(routes.size());
  for (std::size_t pass = 0; pass <= 2 * jobs_.size() + 1; ++pass) {
    times.total = 0;
    for (std::size_t a = 0; a < routes.size(); ++a) {
      double end = times.ends[a] = delay(a);
      for (std::size_t k = 0; k < routes[a].size(); ++k) {
        const std::size_t job = routes[a][k];
        const double arrival =
            k == 0 ? start(a, job) : end + leg(a, routes[a][k - 1], job);
        end = std::max({arrival, jobs_[job].opens, earliest[job]}) + within(a, job);
        done[job] = end;
        if (jobs_[job].needs.endless || end >= kNever) continue;
        times.ends[a] = end;
        times.total += end;
      }
    }
    bool is_later = false;
    for (const TaskRelation& r : problem_.relations)
      if (done[r.first] > earliest[r.second]) {
        earliest[r.second] = done[r.first];
        is_later = true;
      }
    if (!is_later) return times;
  }
  return std::nullopt;
}

SequenceRoutes TeamSequences::routes_of(const TeamAllocation& plan) const {
  std::map<std::uint32_t, std::size_t> places;
  for (std::size_t k = 0; k < jobs_.size(); ++k) places[jobs_[k].task->number] = k;
  SequenceRoutes routes(flyers_.size());
  for (std::size_t a = 0; a < flyers_.size(); ++a) {
    const auto own = plan.find(flyers_[a].id);
    if (own == plan.end()) continue;
    for (const std::uint32_t number : own->second) {
      const auto place = places.find(number);
      if (place == places.end() || !problem_.tasks[place->second].eligible[a]) continue;
      routes[a].push_back(place->second);
      places.erase(place);
    }
  }
  insert_missing(routes);
  return routes;
}

void TeamSequences::insert_missing(SequenceRoutes& routes) const {
  std::vector<bool> placed(jobs_.size(), false);
  for (const auto& route : routes)
    for (const std::size_t k : route) placed[k] = true;
  for (std::size_t k = 0; k < jobs_.size(); ++k) {
    if (placed[k]) continue;
    double least = math::kInfinity;
    std::vector<std::size_t> best_route;
    std::size_t best = 0;
    for (std::size_t a = 0; a < flyers_.size(); ++a) {
      if (!problem_.tasks[k].eligible[a]) continue;
      for (std::size_t at = 0; at <= routes[a].size(); ++at) {
        std::vector<std::size_t> route = routes[a];
        route.insert(route.begin() + static_cast<std::ptrdiff_t>(at), k);
        const double end = end_of(a, route);
        if (end >= least) continue;
        least = end;
        best = a;
        best_route = std::move(route);
      }
    }
    routes[best] = std::move(best_route);
  }
}

TeamAllocation TeamSequences::plan_of(const SequenceRoutes& routes) const {
  TeamAllocation plan;
  for (std::size_t a = 0; a < flyers_.size(); ++a) {
    std::vector<std::uint32_t>& own = plan[flyers_[a].id];
    if (flyers_[a].begun) own.push_back(*flyers_[a].begun);
    for (const std::size_t k : routes[a]) own.push_back(jobs_[k].task->number);
  }
  return plan;
}

SequenceRoutes TeamSequences::within_endurance(SequenceRoutes routes) const {
  for (std::size_t a = 0; a < routes.size(); ++a) {
    const Flyer& flyer = flyers_[a];
    std::vector<std::size_t>& route = routes[a];
    double flown = 0;
    for (std::size_t k = 0; k < route.size(); ++k) {
      const TaskNeeds& needs = jobs_[route[k]].needs;
      if (k > 0 && jobs_[route[k - 1]].needs.endless) {
        route.resize(k);
        break;
      }
      flown += k == 0 ? start(a, route[0]) - flyer.delay : leg(a, route[k - 1], route[k]);
      flown += within(a, route[k]);
      const double home = seconds(time_home(needs, flyer.free, conditions_));
      if (needs.endless || kEnduranceReserve * (flown + home) <= flyer.free.endurance)
        continue;
      route.resize(k);
      break;
    }
  }
  return routes;
}

}  // namespace skein::reasoning
