#include "skein/layer/reasoning/agent/onboard_agent.h"

#include <fmt/format.h>

#include <utility>

namespace skein::reasoning {

OnboardAgent::OnboardAgent(const OnboardAgentOptions& options, EntityId station,
                           const TaskContext& context, std::span<const Zone> zones,
                           MakeTask make)
    : options_(options),
      context_(context),
      make_(std::move(make)),
      safety_(options.avoidance, options.safety_zone, context.self, context.limits,
              *context.map, zones),
      readings_(context.self, station),
      report_(station, options.report_period) {
  if (options_.first_task) executor_ = make_(*options_.first_task);
}

void OnboardAgent::step(const AgentInput& in, AgentOutput& out) {
  if (options_.takes_orders)
    for (const Message& message : in.inbox)
      if (const auto* task = std::get_if<Task>(&message.content))
        take(*task, in.now, out);
  safety_.listen(in, out);
  if (!in.nav) return;
  readings_.step(in, out);
  fly({in, readings_.latest(), safety_}, out);
  safety_.finish(in, out);
  report_.step(in, context_.limits, {number_, task_done()},
               safety_.zones().changes_known(), out);
}

void OnboardAgent::take(const Task& task, Time now, AgentOutput& out) {
  if (number_ > 0 && task.number <= number_) return;
  auto executor = make_(task.what);
  if (!executor) {
    out.events.push_back({now, context_.self, "task-refused",
                          fmt::format("{}: this aircraft cannot", kind_of(task.what))});
    return;
  }
  number_ = task.number;
  executor_ = std::move(executor);
  safety_.forget_setpoint();
  out.events.push_back({now, context_.self, "task",
                        fmt::format("task {}: {}", number_, kind_of(task.what))});
}

void OnboardAgent::fly(const TaskStep& step, AgentOutput& out) {
  if (executor_) executor_->listen(step);
  if (!safety_.may_fly(step.in, altitude_to_take_off_to(*step.in.nav), out)) return;
  if (!executor_) executor_ = make_(Loiter{safety_.home()});
  if (executor_) executor_->fly(step, out);
}

double OnboardAgent::altitude_to_take_off_to(const NavEstimate& nav) const {
  if (executor_)
    if (const auto altitude = executor_->altitude_msl()) return *altitude;
  return context_.map->elevation_msl(geo::horizontal(nav.p_N)) + context_.altitude_agl;
}

}  // namespace skein::reasoning
