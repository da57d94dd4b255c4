// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "skein/layer/reasoning/agent/planner_chain.h"

namespace skein::reasoning {

/// The second planner of the chain: has the tasks of an aircraft, takes orders, and flies
/// what the present task needs. While that is paused, impossible or still computing it
/// passes on what it is given.
class TaskPlanner final : public PlannerOfChain {
 public:
  /// @param context  of the aircraft; outlives this, which changes height and speed as
  ///                 it is ordered to (FlightChange).
  TaskPlanner(FlightContext& context, EntityId station, MakeTask make)
      : context_(context), station_(station), make_(std::move(make)) {}

  /// What is flown until an order comes.
  void begin(const TaskKind& task);

  /// Takes in orders. The newest counts, however they arrive.
  /// @returns  whether there is another task.
  bool receive(const AgentInput& in, AgentOutput& out);

  /// What the aircraft's team gives it, in place of what it flew; none: nothing, it has
  /// no task then. Counts while no order of the station is flown or paused.
  /// @param number  of the task, in the team's mission.
  /// @returns  whether there is another task.
  bool assign(std::optional<std::uint32_t> number, const std::optional<TaskKind>& what,
              Time now, AgentOutput& out);

  /// An order of the station is flown, or it has paused what is flown.
  bool is_ordered() const {
    return state_ == TaskState::kPaused || (number_ > 0 && state_ == TaskState::kFlying);
  }
  /// The team's task that it has; none: none.
  std::optional<std::uint32_t> assigned() const { return assigned_; }

  /// At each step with a navigation estimate.
  void listen(const TaskStep& step);

  const FlightIntent* plan(const FlightIntent* given, const TaskStep& step,
                           AgentOutput& out) override;
  void replaced() override { executor_->interrupt(); }
  std::string_view reason() const override;

  /// Reports what is left of the task when that has changed, and now and then.
  void report(const AgentInput& in, AgentOutput& out);

  /// Of the newest order; 0: none was received.
  std::uint32_t order() const { return order_; }
  TaskState state() const { return state_; }
  TaskProgress progress(const AgentInput& in) const;

  /// The present task flies; else it is none, paused or impossible.
  bool flies() const {
    return state_ == TaskState::kFlying || state_ == TaskState::kDone;
  }
  bool may_stand() const { return executor_ && executor_->may_stand(); }
  std::optional<double> altitude_msl() const;

 private:
  bool take(const Task& task, const AgentInput& in, AgentOutput& out);
  void refuse(Time now, std::string_view why, AgentOutput& out);
  bool fly(const TaskKind& what, Time now, AgentOutput& out);
  std::string named() const;
  EventNumbers numbers() const;
  void obey(const TaskChange& change, Time now, AgentOutput& out);
  void obey(const FlightChange& change, const AgentInput& in, AgentOutput& out);
  void begin_again(const FlightChange& change, Time now, AgentOutput& out);
  void set(TaskState state, Time now, EventKind event, std::string_view why,
           AgentOutput& out);

  FlightContext& context_;
  EntityId station_;
  MakeTask make_;
  std::unique_ptr<TaskExecutor> executor_;
  std::string kind_;                       // of the present task
  std::string refused_;                    // why the last one could not be flown
  std::uint32_t order_ = 0;                // newest
  std::uint32_t flight_change_ = 0;        // newest
  std::uint32_t number_ = 0;               // of the present task; 0: of no order
  std::optional<std::uint32_t> assigned_;  // by the team
  TaskState state_ = TaskState::kNone;
  bool computing_ = false;  // it had nothing to say at the last step
  struct Reported {
    TaskState state = TaskState::kNone;
    std::uint32_t number = 0, version = 0;
    bool operator==(const Reported&) const = default;
  } reported_;
  Time report_again_;
};

}  // namespace skein::reasoning
