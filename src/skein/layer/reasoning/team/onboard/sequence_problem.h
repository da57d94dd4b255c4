// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <vector>

#include "skein/layer/reasoning/team/onboard/task_needs.h"
#include "skein/layer/reasoning/team/protocol/allocation.h"
#include "skein/solve/allocation/sequence_schedule.h"
#include "skein/solve/allocation/sequences.h"

namespace skein::reasoning {

/// A team's tasks and aircraft as a problem of sequences: tasks that nobody has begun,
/// and from where and when each aircraft is free for them.
class TeamSequences {
 public:
  /// Time of what cannot be flown [s], and of what follows on something without an end.
  static constexpr double kNever = 1e7;

  /// @param max_tasks   that are planned, those with the lowest numbers that can be.
  /// @param conditions  must outlive it, as what the tasks and workers are in.
  TeamSequences(std::span<const TeamTask> tasks, std::span<const TeamWorker> workers,
                std::size_t max_tasks, const FlightConditions& conditions);
  TeamSequences(const TeamSequences&) = delete;
  TeamSequences& operator=(const TeamSequences&) = delete;

  std::size_t tasks() const { return jobs_.size(); }
  std::size_t aircraft() const { return flyers_.size(); }
  bool is_tied() const { return !problem_.relations.empty(); }
  bool has_endless() const;
  const solve::SequenceProblem& problem() const { return problem_; }

  /// The same for some of the tasks and some of the aircraft, by their numbers in it;
  /// refers to this one.
  solve::SequenceProblem part(const std::vector<std::size_t>& tasks,
                              const std::vector<std::size_t>& aircraft) const;

  /// Until an aircraft is free [s].
  double delay(std::size_t aircraft) const { return flyers_[aircraft].delay; }
  /// Of tasks that have an end.
  struct Times {
    std::vector<double> ends;  ///< when each aircraft has done its last [s]
    double total = 0;          ///< sum over tasks of when each is done [s]
    double last() const;
  };
  /// None: tasks wait for each other without end.
  std::optional<Times> times(const solve::SequenceRoutes& routes) const;

  /// A plan as routes; without what is gone or may not be flown, and with each task that
  /// it lacks where the last end is least.
  solve::SequenceRoutes routes_of(const TeamAllocation& plan) const;
  /// Routes as a plan, with what has been begun before.
  TeamAllocation plan_of(const solve::SequenceRoutes& routes) const;
  /// As much of routes as the endurance of each aircraft allows, and at most one task
  /// without an end, which is the last.
  solve::SequenceRoutes within_endurance(solve::SequenceRoutes routes) const;

 private:
  struct Job {
    const TeamTask* task;
    TaskNeeds needs;
    double opens = 0;  // what it comes after is being flown so long [s]
  };
  struct Flyer {
    EntityId id;
    TeamResources free;  // after what it has begun
    double delay = 0;    // until then [s]
    std::optional<std::uint32_t> begun = {};
  };

  Flyer flyer_of(const TeamWorker& worker, std::span<const TeamTask> tasks,
                 std::set<std::uint32_t>& begun) const;
  bool may_fly(const Flyer& flyer, const Job& job) const;
  void choose_jobs(std::span<const TeamTask> tasks, const std::set<std::uint32_t>& begun,
                   std::size_t max_tasks);
  void make_problem();
  double within(std::size_t aircraft, std::size_t job) const {
    return within_[aircraft * jobs_.size() + job];
  }
  double start(std::size_t aircraft, std::size_t job) const;
  double leg(std::size_t aircraft, std::size_t from, std::size_t to) const;
  double end_of(std::size_t aircraft, const std::vector<std::size_t>& route) const;
  void insert_missing(solve::SequenceRoutes& routes) const;

  const FlightConditions& conditions_;
  std::vector<Job> jobs_;
  std::vector<Flyer> flyers_;
  std::vector<double> within_;  // by aircraft and job, of the task itself [s]
  // Between jobs, by speed [s]; negative: not asked for yet.
  mutable std::map<double, std::vector<double>> legs_;
  solve::SequenceProblem problem_;
};

}  // namespace skein::reasoning
