// SPDX-License-Identifier: Apache-2.0
// The kinds of tasks: one row each.

#include "skein/assemble/kinds/task_kinds.h"

#include <type_traits>
#include <utility>

#include "skein/assemble/kinds/task_row.h"
#include "skein/layer/reasoning/task/course/course_task.h"
#include "skein/layer/reasoning/task/edge/edge_task.h"
#include "skein/layer/reasoning/task/follow/follow_task.h"
#include "skein/layer/reasoning/task/go_to/go_to_task.h"
#include "skein/layer/reasoning/task/home/home_task.h"
#include "skein/layer/reasoning/task/line/line_task.h"
#include "skein/layer/reasoning/task/measure/measure_task.h"
#include "skein/layer/reasoning/task/orbit/orbit_task.h"
#include "skein/layer/reasoning/task/patrol/patrol_task.h"
#include "skein/layer/reasoning/task/plan/plan_task.h"
#include "skein/layer/reasoning/task/relay/relay_task.h"
#include "skein/layer/reasoning/task/rendezvous/rendezvous_task.h"
#include "skein/layer/reasoning/task/route/route_task.h"
#include "skein/layer/reasoning/task/stay/stay_task.h"
#include "skein/layer/reasoning/task/survey/survey_task.h"

namespace skein::assemble {
namespace {

using namespace reasoning;
using MadeTask = TaskKinds::Made;

MadeTask cannot(std::string why) {
  return Error{ErrorCode::kBadInput, "", std::move(why), ""};
}

template <class Executor, class... Arguments>
MadeTask make_executor(Arguments&&... arguments) {
  return std::unique_ptr<TaskExecutor>(
      std::make_unique<Executor>(std::forward<Arguments>(arguments)...));
}

// What flies tasks that need no more than their values.
template <class Executor>
constexpr auto flown_by = [](const auto& task, const TaskContext& c) {
  if constexpr (std::is_constructible_v<Executor, decltype(c.flight), decltype(task)>)
    return std::make_unique<Executor>(c.flight, task);
  else
    return std::make_unique<Executor>(task);
};

MadeTask make_edge_task(FollowEdge task, const TaskContext& c) {
  task.angle = c.options.edge_angle.value_or(task.angle);
  return make_executor<EdgeTask>(c.flight, c.options.edge, task);
}

MadeTask make_follow_task(const FollowLeader& task, const TaskContext& c) {
  if (task.leader == c.flight.self) return cannot("an aircraft cannot follow itself.");
  return make_executor<FollowTask>(c.flight, task, c.options.follow_horizon);
}

MadeTask make_orbit_task(const Orbit& task, const TaskContext& c) {
  if (task.object && !c.options.has_camera)
    return cannot("it has no camera to see an object with.");
  return make_executor<OrbitTask>(c.flight, task);
}

MadeTask make_relay_task(const Relay& task, const TaskContext& c) {
  if (task.first == c.flight.self || task.second == c.flight.self)
    return cannot("an aircraft is no relay to itself.");
  return make_executor<RelayTask>(task);
}

}  // namespace

TaskKinds task_kinds() {
  TaskKinds kinds;
  kinds.add<Loiter>(flown_by<StayTask>);
  kinds.add<FlyTo>([](const FlyTo& t, const TaskContext& c) {
    return make_executor<GoToTask>(c.flight, t, c.options.stays);
  });
  kinds.add<FollowEdge>(make_edge_task);
  kinds.add<FollowLine>(flown_by<LineTask>);
  kinds.add<FlyCourse>(flown_by<CourseTask>);
  kinds.add<FlyRoute>([](const FlyRoute& t, const TaskContext& c) {
    return make_executor<RouteTask>(c.flight, t, c.options.lands);
  });
  kinds.add<FollowLeader>(make_follow_task);
  kinds.add<FlyTour>([](const FlyTour& t, const TaskContext& c) {
    return make_executor<TourTask>(c.flight, t, c.options.tour);
  });
  kinds.add<Hold>(flown_by<StayTask>);
  kinds.add<Survey>(flown_by<SurveyTask>);
  kinds.add<Patrol>(flown_by<PatrolTask>);
  kinds.add<Orbit>(make_orbit_task);
  kinds.add<Measure>(flown_by<MeasureTask>);
  kinds.add<Rendezvous>(flown_by<RendezvousTask>);
  kinds.add<Relay>(make_relay_task);
  kinds.add<FlyPlan>(flown_by<PlanTask>);
  kinds.add<ReturnHome>([](const ReturnHome&, const TaskContext& c) {
    return make_executor<ReturnTask>(c.flight);
  });
  kinds.add<LandAt>(flown_by<LandTask>);
  return kinds;
}

}  // namespace skein::assemble
