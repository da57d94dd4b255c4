// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "skein/layer/reasoning/agent/task_executor.h"

namespace skein::reasoning {

/// Flies through points by straight legs, lap after lap, then stays at the last of them,
/// or lands: where it took off or, when it began in the air, at the first of them. Where
/// others are to keep beside it, it flies slower than it could and reports to them.
class RouteTask final : public TaskExecutor {
 public:
  /// @param lands  after the last lap.
  RouteTask(const FlightContext& context, const FlyRoute& order, bool lands);

  const FlightIntent* plan(const TaskStep& step, AgentOutput& out) override;
  TaskProgress progress(const AgentInput& in) const override;
  TaskKind rest() const override;
  std::uint32_t version() const override { return static_cast<std::uint32_t>(passed_); }
  void interrupt() override;
  std::optional<double> altitude_msl() const override { return legs_.altitude_msl; }
  bool may_stand() const override { return done_ && lands_; }

 private:
  void begin(std::uint32_t number);
  void report(const TaskStep& step, AgentOutput& out);
  void land(const TaskStep& step);
  FlyRoute left() const;

  EntityId self_;
  FlyRoute order_;
  bool lands_;
  Legs legs_;  // of all that was ordered
  FlightIntent intent_;
  std::size_t begun_at_ = 0;  // points passed when the present intent began
  std::size_t passed_ = 0;
  std::optional<Time> next_report_;
  bool done_ = false, landing_ = false;
  bool interrupted_ = true;  // its flight is to begin, with what is left
};

}  // namespace skein::reasoning
