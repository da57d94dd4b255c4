// What flies each kind of task: one function each.

#include "skein/assemble/task_kinds.h"

#include "skein/layer/reasoning/task/course_task.h"
#include "skein/layer/reasoning/task/edge_task.h"
#include "skein/layer/reasoning/task/line_task.h"
#include "skein/layer/reasoning/task/point_task.h"
#include "skein/layer/reasoning/task/route_task.h"
#include "skein/layer/reasoning/team/follow_task.h"

namespace skein::assemble {
namespace {

using namespace reasoning;
using Made = std::unique_ptr<TaskExecutor>;

// An overload for each kind: the compiler names one that is missing.
struct TaskMaker {
  Made operator()(const Loiter& order) const {
    return std::make_unique<PointTask>(context, order.centre, PointTask::Goal::kCircle);
  }
  Made operator()(const FlyTo& order) const {
    return std::make_unique<PointTask>(context, order.point, PointTask::Goal::kReach);
  }
  Made operator()(const FollowEdge& order) const {
    FollowEdge own = order;
    own.angle = options.edge_angle.value_or(order.angle);
    return std::make_unique<EdgeTask>(context, options.edge, own);
  }
  Made operator()(const FollowLine& order) const {
    return std::make_unique<LineTask>(context, order);
  }
  Made operator()(const FlyCourse& order) const {
    return std::make_unique<CourseTask>(context, order.course);
  }
  Made operator()(const FlyRoute& order) const {
    if (order.points.empty()) return nullptr;
    return std::make_unique<RouteTask>(context, order, options.lands);
  }
  Made operator()(const FollowLeader& order) const {
    if (order.leader == context.self) return nullptr;
    return std::make_unique<FollowTask>(context, order, options.follow_horizon);
  }
  Made operator()(const FlyTour& order) const {
    if (order.points.size() < 2) return nullptr;
    return std::make_unique<TourTask>(context, order, options.tour);
  }

  const TaskContext& context;
  const TaskOptions& options;
};

}  // namespace

std::unique_ptr<TaskExecutor> make_task(const TaskKind& task, const TaskContext& context,
                                        const TaskOptions& options) {
  return std::visit(TaskMaker{context, options}, task);
}

}  // namespace skein::assemble
