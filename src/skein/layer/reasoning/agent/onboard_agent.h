#pragma once

#include <memory>
#include <optional>
#include <span>

#include "skein/layer/reasoning/agent/fire_readings.h"
#include "skein/layer/reasoning/agent/flight_safety.h"
#include "skein/layer/reasoning/agent/status_report.h"
#include "skein/layer/reasoning/agent/task_executor.h"
#include "skein/role/agent.h"

namespace skein::reasoning {

struct OnboardAgentOptions {
  double report_period = 1;  ///< between reports to the station [s]
  SafetyZone safety_zone = {};
  ZoneAvoidanceOptions avoidance = {};
  std::optional<TaskKind> first_task = {};  ///< until an order comes
  bool takes_orders = true;
};

/// The agent on board of an aircraft, whatever its task.
///
/// It flies the newest task it has received; without messages it goes on with the last,
/// and before the first it circles where it began. It sends the readings of its fire
/// sensor and a report each second to the station. It takes off first, as long as no
/// no-fly zone forbids it, and whatever it flies stays out of zones (FlightSafety).
class OnboardAgent final : public Agent {
 public:
  /// @param station  who gets its reports.
  /// @param zones    no-fly zones in force from the start, copied.
  /// @param make     makes the executors of tasks.
  OnboardAgent(const OnboardAgentOptions& options, EntityId station,
               const TaskContext& context, std::span<const Zone> zones, MakeTask make);

  void step(const AgentInput& in, AgentOutput& out) override;

  /// Of the newest task that it has taken; 0: none.
  std::uint32_t task_number() const { return number_; }
  bool task_done() const { return executor_ && executor_->done(); }

 private:
  void take(const Task& task, Time now, AgentOutput& out);
  void fly(const TaskStep& step, AgentOutput& out);
  double altitude_to_take_off_to(const NavEstimate& nav) const;

  OnboardAgentOptions options_;
  TaskContext context_;
  MakeTask make_;
  FlightSafety safety_;
  FireReadings readings_;
  StatusReport report_;
  std::uint32_t number_ = 0;  // of the newest task; 0: none was received
  std::unique_ptr<TaskExecutor> executor_;
};

}  // namespace skein::reasoning
