// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "skein/data/vehicle/planner_change.h"
#include "skein/layer/reasoning/agent/advised_pilot.h"
#include "skein/layer/reasoning/agent/separation_planner.h"
#include "skein/layer/reasoning/agent/task_executor.h"
#include "skein/layer/reasoning/trajectory/trajectory_planner.h"

namespace skein::reasoning {

/// A planner of the chain.
class PlannerOfChain {
 public:
  virtual ~PlannerOfChain() = default;

  /// What shall be flown.
  /// @param given  by the planner before; null: by the first only.
  /// @returns  `given` itself to pass it on, which who is still computing does too; else
  ///           what is flown instead, good until the next call.
  virtual const FlightIntent* plan(const FlightIntent* given, const TaskStep& step,
                                   AgentOutput& out) = 0;

  /// What it said was replaced by a planner behind it.
  virtual void replaced() {}

  /// Why the last answer was what it was; lives as long as the program.
  virtual std::string_view reason() const = 0;
};

/// The backbone of a step on board: loiter, task, separation, trajectory, autopilot. Each
/// planner modifies or replaces what it is handed, or passes it on, so that there is
/// always something to fly; who does what, and why, is recorded whenever it changes.
class PlannerChain {
 public:
  /// @param pilot  who is shown what keeps apart from others; none: that is flown.
  /// @param context, loiter, task  outlive it.
  PlannerChain(const FlightContext& context, const SeparationOptions& separation,
               const std::optional<AdvisedPilotOptions>& pilot, PlannerOfChain& loiter,
               PlannerOfChain& task)
      : links_{&loiter, &task}, separation_(context, separation), trajectory_(context) {
    if (pilot) pilot_.emplace(context.self, *pilot);
  }
  PlannerChain(const PlannerChain&) = delete;
  PlannerChain& operator=(const PlannerChain&) = delete;

  /// Takes in what others say to keep apart, and says that it has landed. At each step.
  void listen(const AgentInput& in, AgentOutput& out) { separation_.listen(in, out); }

  /// Commands what is flown.
  void fly(const TaskStep& step, AgentOutput& out);

  /// The aircraft stands or takes off: nobody is asked.
  void stand(std::string_view reason, AgentOutput& out);

  /// How the flight goes that the task wants.
  const FlightProgress& progress() const { return progress_; }

  /// What the task asks for, whoever else is in the way; null before the first flight.
  /// Good until the next call of fly().
  const FlightIntent* wanted() const { return wanted_; }

 private:
  struct Said {
    PlannerVerdict verdict = PlannerVerdict::kPassedOn;
    std::string_view reason;
    bool operator==(const Said&) const = default;
  };
  void note(PlannerLink link, const Said& said, AgentOutput& out);

  std::array<PlannerOfChain*, 2> links_;  // loiter, task
  SeparationPlanner separation_;
  std::optional<AdvisedPilot> pilot_;
  const FlightIntent* wanted_ = nullptr;
  TrajectoryPlanner trajectory_;
  FlightProgress progress_;
  std::array<Said, kPlannerLinks> said_{};
};

}  // namespace skein::reasoning
