// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>

#include "skein/data/event/record.h"

namespace skein::record {

/// How a team led itself: the part of a run's key figures that is there as soon as
/// somebody says who leads it.
class TeamStatistics {
 public:
  void lead(const TeamLeadRecord& record);
  void allocation(const TeamAllocationReport& report);
  /// kTeamTask, kTeamTaskOver, kLeft and kAccident say who flies which task, kTaskDone
  /// what is done.
  void event(const Event& event);

  /// Adds `team_masters` (that anybody followed, stations included), `team_changes` (of
  /// the master, as members saw them), `team_tasks_done`, and of tasks for one aircraft
  /// `team_double_max_s`: the longest time for which two flew the same one, from when the
  /// second began, and `team_double_total_s`: all such times together. Where allocations
  /// wait for approval also `team_allocations_proposed`, `team_allocations_approved`,
  /// `team_allocations_rejected` and `team_allocations_taken_over`.
  /// @param now  of the run: what two fly then counts until then.
  void add_figures(std::map<std::string, double>& figures, Time now) const;

 private:
  void begin(std::uint32_t task, EntityId who, Time now);
  void end(EntityId who, Time now);

  struct Flown {
    std::set<EntityId> by;
    std::optional<Time> doubled;  // since when by two or more
  };
  bool known_ = false;
  std::set<EntityId> masters_;
  std::map<EntityId, std::optional<EntityId>> master_of_;
  double changes_ = 0, doubled_max_ = 0, doubled_total_ = 0;
  std::map<AllocationState, double> allocations_;
  std::set<std::uint32_t> done_;
  std::map<std::uint32_t, Flown> flown_;
};

}  // namespace skein::record
