// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "skein/role/mission.h"

namespace skein::reasoning {

/// A mission that gives each of its aircraft one task after the other: keeps account of
/// who is there and how far, and repeats orders until they are acknowledged.
class TaskingMission : public Mission {
 public:
  void step(const AgentInput& in, AgentOutput& out) final;

 protected:
  /// An aircraft of the station, as its reports show it.
  struct Aircraft {
    EntityId id;
    NavEstimate nav;
    std::optional<FlightLimits> limits;  ///< none: it has not said them yet
    bool mine =
        false;  ///< allocated to this mission, in contact, it obeys and has limits
    Time heard;
    double silence_allowed = 0;  ///< from there on [s]
    Task task;                   ///< the last that was ordered; number 0: none
    Time ordered;
    std::uint32_t confirmed = 0;         ///< number of the order that it works on
    TaskState state = TaskState::kNone;  ///< of the task, once it is confirmed
    double share = 0;                    ///< of it that is done
    std::optional<double> time_to_go = {};
    std::optional<TaskReport> left = {};  ///< what is left of the task, as last said

    bool idle() const {
      return task.number == 0 ||
             (confirmed == task.number && state != TaskState::kFlying &&
              state != TaskState::kPaused);
    }
    bool has_done() const {
      return task.number > 0 && confirmed == task.number && state == TaskState::kDone;
    }
  };

  explicit TaskingMission(const std::vector<EntityId>& team);

  /// Decides. Called at each step, after reports have been taken in.
  virtual void pursue(const AgentInput& in, AgentOutput& out) = 0;

  void order(Aircraft& aircraft, TaskKind what, Time now, AgentOutput& out);

  /// What an aircraft still has to do of its task.
  static const TaskKind& rest_of(const Aircraft& aircraft);

  std::vector<Aircraft>& team() { return team_; }
  const std::vector<Aircraft>& team() const { return team_; }
  int mine() const;

 private:
  void listen(const AgentInput& in);
  static void send(Aircraft& aircraft, Time now, AgentOutput& out);

  std::vector<Aircraft> team_;
};

}  // namespace skein::reasoning
