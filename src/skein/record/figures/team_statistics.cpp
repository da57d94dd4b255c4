// SPDX-License-Identifier: Apache-2.0
#include "skein/record/figures/team_statistics.h"

#include <algorithm>

namespace skein::record {
void TeamStatistics::lead(const TeamLeadRecord& record) {
  known_ = true;
  const auto& master = record.value.master;
  if (!master) return;
  masters_.insert(*master);
  auto& last = master_of_[record.id];
  if (last && *last != *master) changes_ += 1;
  last = master;
}

void TeamStatistics::allocation(const TeamAllocationReport& report) {
  ++allocations_[report.state];
}

void TeamStatistics::event(const Event& event) {
  const auto& task = event.numbers.team_task;
  switch (event.kind.kind()) {
    case EventKind::kTaskDone:
      if (!task) return;
      done_.insert(*task);
      return end(event.entity, event.time);
    case EventKind::kTeamTaskOver:
    case EventKind::kLeft:
    case EventKind::kAccident:
      return end(event.entity, event.time);
    case EventKind::kTeamTask:
      end(event.entity, event.time);
      // Those for groups have no number.
      if (task) begin(*task, event.entity, event.time);
      return;
    default:
      return;
  }
}

void TeamStatistics::begin(std::uint32_t task, EntityId who, Time now) {
  Flown& flown = flown_[task];
  flown.by.insert(who);
  if (flown.by.size() == 2) flown.doubled = now;
}

void TeamStatistics::end(EntityId who, Time now) {
  for (auto& [task, flown] : flown_) {
    if (flown.by.erase(who) == 0 || flown.by.size() >= 2 || !flown.doubled) continue;
    const double doubled = (now - *flown.doubled).seconds();
    doubled_max_ = std::max(doubled_max_, doubled);
    doubled_total_ += doubled;
    flown.doubled.reset();
  }
}

void TeamStatistics::add_figures(std::map<std::string, double>& figures, Time now) const {
  if (!known_) return;
  double longest = doubled_max_, total = doubled_total_;
  for (const auto& [task, flown] : flown_) {
    if (!flown.doubled) continue;
    const double doubled = (now - *flown.doubled).seconds();
    longest = std::max(longest, doubled);
    total += std::max(0.0, doubled);
  }
  figures["team_masters"] = static_cast<double>(masters_.size());
  figures["team_changes"] = changes_;
  figures["team_tasks_done"] = static_cast<double>(done_.size());
  figures["team_double_max_s"] = longest;
  figures["team_double_total_s"] = total;
  const auto count = [&](AllocationState state) {
    const auto found = allocations_.find(state);
    return found == allocations_.end() ? 0 : found->second;
  };
  if (count(AllocationState::kWaits) == 0) return;
  figures["team_allocations_proposed"] = count(AllocationState::kWaits);
  figures["team_allocations_approved"] = count(AllocationState::kApproved);
  figures["team_allocations_rejected"] = count(AllocationState::kRejected);
  figures["team_allocations_taken_over"] = count(AllocationState::kTakenOver);
}

}  // namespace skein::record
