// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "skein/layer/reasoning/mission/tasking_mission.h"

namespace skein::reasoning {

/// One task of a list.
struct ListedTask {
  TaskKind what = Hold{};
  std::optional<EntityId> aircraft = {};  ///< who flies it; none: whoever is free
};

/// Has a list of tasks flown: each by the aircraft that it names or by the nearest that
/// is free, in the order of the list. A task that is left unfinished, as its aircraft is
/// lost or taken away, goes on with another where it was left.
class TaskMission final : public TaskingMission {
 public:
  TaskMission(const std::vector<EntityId>& team, std::vector<ListedTask> tasks);

  MissionDemand demand() const override;
  bool done() const override;

 private:
  struct Entry {
    ListedTask task;
    std::optional<EntityId> flown_by = {};
    bool over = false;  // done, or impossible
  };
  void pursue(const AgentInput& in, AgentOutput& out) override;
  void look_at(Entry& entry, Time now, AgentOutput& out);
  Aircraft* free_for(const Entry& entry);

  std::vector<Entry> entries_;
};

}  // namespace skein::reasoning
