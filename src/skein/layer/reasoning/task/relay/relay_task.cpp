// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/task/relay/relay_task.h"

namespace skein::reasoning {
namespace {

constexpr double kMoved = 25;  // the place, before the circle is moved [m]

}  // namespace

const FlightIntent* RelayTask::plan(const TaskStep& step, AgentOutput&) {
  const auto first = step.beliefs.team().find(order_.first);
  const auto second = step.beliefs.team().find(order_.second);
  if (!first || !second) return placed_ ? &intent_ : nullptr;
  const Vec2 place = (geo::horizontal(first->p_N) + geo::horizontal(second->p_N)) / 2;
  const auto* last = placed_ ? std::get_if<Circling>(&intent_.what) : nullptr;
  if (!last || (last->centre - place).norm() > kMoved) intent_.what = Circling{place, {}};
  placed_ = true;
  return &intent_;
}

}  // namespace skein::reasoning
