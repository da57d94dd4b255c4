// SPDX-License-Identifier: Apache-2.0
// What flies each kind of task: one row each.

#include "skein/assemble/kinds/task_kinds.h"

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
using MadeTask = Result<std::unique_ptr<TaskExecutor>>;

Error cannot(std::string why) {
  return {ErrorCode::kBadInput, "", std::move(why), ""};
}

// An overload for each kind: the compiler names one that is missing.
struct TaskMaker {
  template <class Executor, class... Arguments>
  static MadeTask make(Arguments&&... arguments) {
    return std::unique_ptr<TaskExecutor>(
        std::make_unique<Executor>(std::forward<Arguments>(arguments)...));
  }

  MadeTask operator()(const Loiter& t) const { return make<StayTask>(t); }
  MadeTask operator()(const Hold& t) const { return make<StayTask>(t); }
  MadeTask operator()(const FlyTo& t) const {
    return make<GoToTask>(context, t, options.stays);
  }
  MadeTask operator()(const FollowEdge& t) const {
    FollowEdge own = t;
    own.angle = options.edge_angle.value_or(t.angle);
    return make<EdgeTask>(context, options.edge, own);
  }
  MadeTask operator()(const FollowLine& t) const { return make<LineTask>(context, t); }
  MadeTask operator()(const FlyCourse& t) const { return make<CourseTask>(context, t); }
  MadeTask operator()(const FlyRoute& t) const {
    return make<RouteTask>(context, t, options.lands);
  }
  MadeTask operator()(const FollowLeader& t) const {
    if (t.leader == context.self) return cannot("an aircraft cannot follow itself.");
    return make<FollowTask>(context, t, options.follow_horizon);
  }
  MadeTask operator()(const FlyTour& t) const {
    return make<TourTask>(context, t, options.tour);
  }
  MadeTask operator()(const Survey& t) const { return make<SurveyTask>(context, t); }
  MadeTask operator()(const Patrol& t) const { return make<PatrolTask>(context, t); }
  MadeTask operator()(const Orbit& t) const {
    if (t.object && !options.has_camera)
      return cannot("it has no camera to see an object with.");
    return make<OrbitTask>(context, t);
  }
  MadeTask operator()(const Measure& t) const { return make<MeasureTask>(context, t); }
  MadeTask operator()(const Rendezvous& t) const {
    return make<RendezvousTask>(context, t);
  }
  MadeTask operator()(const Relay& t) const {
    if (t.first == context.self || t.second == context.self)
      return cannot("an aircraft is no relay to itself.");
    return make<RelayTask>(t);
  }
  MadeTask operator()(const FlyPlan& t) const { return make<PlanTask>(context, t); }
  MadeTask operator()(const ReturnHome&) const { return make<ReturnTask>(context); }
  MadeTask operator()(const LandAt& t) const { return make<LandTask>(context, t); }

  const FlightContext& context;
  const TaskOptions& options;
};

}  // namespace

Result<std::unique_ptr<TaskExecutor>> make_task(const TaskKind& task,
                                                const FlightContext& context,
                                                const TaskOptions& options) {
  if (std::string error = task_error(task); !error.empty())
    return cannot(std::move(error));
  return std::visit(TaskMaker{context, options}, task);
}

}  // namespace skein::assemble
