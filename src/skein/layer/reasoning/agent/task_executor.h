#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>

#include "skein/data/agent_step.h"
#include "skein/data/fire.h"
#include "skein/data/task.h"
#include "skein/layer/reasoning/agent/flight_safety.h"
#include "skein/role/path_planner.h"
#include "skein/role/terrain.h"

namespace skein::reasoning {

/// What every task of an aircraft may count on.
struct TaskContext {
  EntityId self;
  FlightLimits limits;
  const Terrain* map = nullptr;  ///< the ground as believed; outlives the tasks
  std::shared_ptr<const PathPlanner> planner;  ///< of paths around zones; null: none
  double altitude_agl = 120;                   ///< to be flown above the ground [m]
};

/// What a task is given at one step.
struct TaskStep {
  const AgentInput& in;                   ///< with a navigation estimate
  std::span<const FireReading> readings;  ///< of the own fire sensor since the last step
  FlightSafety& safety;
};

/// Flies one kind of task. It lives as long as the aircraft has the task.
class TaskExecutor {
 public:
  virtual ~TaskExecutor() = default;

  /// Takes in what was received and sensed. At each step, on the ground too.
  virtual void listen(const TaskStep&) {}

  /// Flies on, at each step in which the aircraft may: commands, and keeps what it
  /// commands out of no-fly zones.
  virtual void fly(const TaskStep& step, AgentOutput& out) = 0;

  /// Nothing is left to do; it goes on to keep the aircraft where the task ends.
  virtual bool done() const { return false; }

  /// To take off to [m]; none: the aircraft's height above the ground.
  virtual std::optional<double> altitude_msl() const { return std::nullopt; }
};

/// Makes the executor of a task; null when this aircraft cannot fly it.
using MakeTask = std::function<std::unique_ptr<TaskExecutor>(const TaskKind&)>;

}  // namespace skein::reasoning
