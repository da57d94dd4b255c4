// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "skein/base/result.h"
#include "skein/data/perimeter/fire.h"
#include "skein/data/team/task.h"
#include "skein/data/vehicle/agent_step.h"
#include "skein/layer/reasoning/agent/flight_safety.h"
#include "skein/layer/reasoning/belief/beliefs.h"
#include "skein/layer/reasoning/trajectory/flight_context.h"
#include "skein/layer/reasoning/trajectory/flight_intent.h"

namespace skein::reasoning {

/// Numbers the intents of all tasks of an aircraft, so that none is taken for another.
class IntentCounter {
 public:
  std::uint32_t next() { return ++last_; }

 private:
  std::uint32_t last_ = 0;
};

/// What a task is given at one step.
struct TaskStep {
  const AgentInput& in;                   ///< with a navigation estimate
  std::span<const FireReading> readings;  ///< of the own fire sensor since the last step
  FlightSafety& safety;
  const Beliefs& beliefs;
  const FlightProgress& flight;  ///< of the last intent that was flown
  IntentCounter& intents;
};

/// How far a task is.
struct TaskProgress {
  bool done = false;
  double share = 0;                       ///< of it that is done, from 0 to 1
  std::optional<double> time_to_go = {};  ///< [s]; none: not known, or it has no end
  std::string impossible = {};  ///< why it cannot be flown any more; empty: it can
};

/// Flies one kind of task: the second link of the planner chain. It lives as long as the
/// aircraft has the task, paused or not.
class TaskExecutor {
 public:
  virtual ~TaskExecutor() = default;

  /// Takes in what was received and sensed. At each step, on the ground and while it is
  /// paused too.
  virtual void listen(const TaskStep&) {}

  /// What shall be flown now. Called at each step in which the aircraft may fly, and
  /// again after a pause, however far it has been carried off meanwhile.
  /// @returns  good until the next call; null while there is nothing to say yet: the
  ///           aircraft then loiters.
  virtual const FlightIntent* plan(const TaskStep& step, AgentOutput& out) = 0;

  virtual TaskProgress progress(const AgentInput& in) const = 0;

  /// What is left, as a task for any aircraft that takes over.
  virtual TaskKind rest() const = 0;

  /// Counts the changes of rest(): it is reported when this changes.
  virtual std::uint32_t version() const { return 0; }

  /// It was paused or another task's flight came between: what it flew is over.
  virtual void interrupt() {}

  /// To take off to [m]; none: the aircraft's height above the ground.
  virtual std::optional<double> altitude_msl() const { return std::nullopt; }

  /// It stays on the ground when it stands there.
  virtual bool may_stand() const { return false; }
};

/// Makes the executor of a task, flown as the context says.
/// Fails: kUnavailable with the reason when this aircraft cannot fly it.
using MakeTask = std::function<Result<std::unique_ptr<TaskExecutor>>(
    const TaskKind&, const FlightContext&)>;

}  // namespace skein::reasoning
