#pragma once

#include <optional>

#include "skein/layer/reasoning/agent/route_flight.h"
#include "skein/layer/reasoning/agent/task_executor.h"

namespace skein::reasoning {

/// Flies through points lap after lap (RouteFlight), then stays at the last of them, or
/// lands: where it took off or, when it began in the air, at the first of them. Where
/// others are to keep beside it, it flies slower than it could and reports to them.
class RouteTask final : public TaskExecutor {
 public:
  /// @param lands  after the last lap.
  RouteTask(const TaskContext& context, const FlyRoute& order, bool lands);

  void listen(const TaskStep& step) override;
  void fly(const TaskStep& step, AgentOutput& out) override;
  bool done() const override { return done_; }
  std::optional<double> altitude_msl() const override { return altitude_msl_; }

 private:
  void report(const TaskStep& step, AgentOutput& out);
  void land(const TaskStep& step, AgentOutput& out);

  EntityId self_;
  const Terrain& map_;
  std::vector<EntityId> report_to_;
  Vec2 first_;
  bool lands_;
  double altitude_msl_;
  RouteFlight flight_;
  std::optional<Time> next_report_;
  std::optional<Vec2> landing_point_;  // where it has been commanded to
  bool done_ = false, land_again_ = false;
};

}  // namespace skein::reasoning
