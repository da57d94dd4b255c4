#include "skein/layer/reasoning/team/wingman.h"

#include <algorithm>
#include <cmath>

#include "skein/layer/reasoning/agent/altitude.h"

namespace skein::reasoning {
namespace {

// On the air: ids, time and content as fixed-point numbers.
constexpr double kTurnRateLimit = 0.6;  // faster is noise of two positions [rad/s]
constexpr double kStaleLeader = 5;      // two positions this far apart say no turn [s]
constexpr std::size_t kAhead = 5;       // point of a plan whose bearing its course is
// Of the range of speeds: the rest is for followers, outside of turns and behind.
constexpr double kLeaderSpeed = 0.4;
constexpr double kLostLeader = 5;  // then the last plan is flown to its end [s]

}  // namespace

Wingman::Wingman(const WingmanOptions& options, EntityId self, EntityId station,
                 const FlightLimits& limits, const Terrain& map,
                 std::span<const Zone> zones, std::shared_ptr<const PathPlanner> planner)
    : options_(options),
      self_(self),
      station_(station),
      limits_(limits),
      map_(map),
      execution_(options.safety_zone),
      zones_(options.avoidance, limits, zones, self),
      returns_(options.avoidance, limits, self, map),
      planner_(std::move(planner)) {}

void Wingman::step(const AgentInput& in, AgentOutput& out) {
  listen(in, out);
  const bool news = zones_.listen(in, out);
  if (!in.nav) return;
  const Vec2 here = geo::horizontal(in.nav->p_N);
  if (!home_) home_ = here;
  returns_.step(in, *home_, zones_.zones(), news, out);
  const double up = map_.elevation_msl(here) + options_.altitude_agl;
  if (!zones_.keeps_on_ground(in, up) && !launch_.takes_off(in, up, out)) fly(in, out);
  zones_.look(in, out);
  if (auto event = execution_.check(in.now, self_, in.autopilot))
    out.events.push_back(*std::move(event));
  report(in, out);
}

void Wingman::fly(const AgentInput& in, AgentOutput& out) {
  const bool leads = std::holds_alternative<FlyRoute>(task_.what);
  if (const auto* order = std::get_if<FollowLeader>(&task_.what); order && has_task_)
    follow(*order, in, out);
  if (leads && task_is_new_) lead(std::get<FlyRoute>(task_.what));
  task_is_new_ = false;
  if (!leads || !route_) return;
  route_->step(in, zones_, execution_.off_plan(), out);
  done_ = route_->done();
}

void Wingman::listen(const AgentInput& in, AgentOutput& out) {
  for (const Message& message : in.inbox) {
    if (const auto* task = std::get_if<Task>(&message.content)) {
      if (has_task_ && task->number <= task_.number) continue;
      task_ = *task;
      has_task_ = task_is_new_ = true;
      done_ = false;
      const bool leads = std::holds_alternative<FlyRoute>(task->what);
      if (!leads && !std::holds_alternative<FollowLeader>(task->what)) {
        out.events.push_back({in.now, self_, "task-refused", "not for this agent"});
        has_task_ = false;
        continue;
      }
      leader_.reset();
      demanded_.reset();
      route_.reset();
      out.events.push_back({in.now, self_, "task", leads ? "leads" : "follows"});
    } else if (const auto* reported = std::get_if<TeamPosition>(&message.content)) {
      hear(*reported);
    }
  }
}

void Wingman::hear(const TeamPosition& reported) {
  const auto* order = std::get_if<FollowLeader>(&task_.what);
  if (!order || reported.aircraft != order->leader) return;
  if (leader_ && reported.nav.time <= leader_->at.time) return;  // overtaken
  LeaderMotion now{reported.nav, 0};
  if (leader_) {
    const double since = (reported.nav.time - leader_->at.time).seconds();
    const double turned = geo::wrap_pi(geo::bearing(geo::horizontal(reported.nav.v_N)) -
                                       geo::bearing(geo::horizontal(leader_->at.v_N)));
    if (since < kStaleLeader)
      now.turn_rate = std::clamp(turned / since, -kTurnRateLimit, kTurnRateLimit);
  }
  leader_ = now;
}

void Wingman::lead(const FlyRoute& route) {
  RouteFlightOptions options;
  options.points = route.points;
  options.laps = route.laps;
  options.altitude_msl = highest_along(map_, route.points) + options_.altitude_agl;
  options.ground_clearance = options_.altitude_agl / 2;
  if (limits_.slowest > 0)
    options.airspeed =
        std::min(limits_.airspeed,
                 limits_.slowest + kLeaderSpeed * (limits_.fastest - limits_.slowest));
  route_.emplace(options, RouteWorld{limits_, &map_, planner_}, self_);
}

void Wingman::follow(const FollowLeader& order, const AgentInput& in, AgentOutput& out) {
  AutopilotCommand command;
  command.altitude_msl = -in.nav->p_N.z();
  if (!leader_) {
    if (!task_is_new_) return;
    command.guidance = HoldPosition{geo::horizontal(in.nav->p_N)};
    out.command = std::move(command);
    return;
  }
  if ((in.now - leader_->at.time).seconds() > kLostLeader) return;
  // What nobody has flown since, or what has come to its end, says nothing of now.
  if (!obeys_orders(in.autopilot) ||
      (demanded_ && demanded_->end() < in.nav->time.seconds()))
    demanded_.reset();
  NavEstimate from = *in.nav;
  if (demanded_) {
    const model::PlanCurve::State height = demanded_->at(from.time.seconds());
    from.p_N.z() = height.p_N.z();
    from.v_N.z() = height.v_N.z();
  }
  command.altitude_msl = -from.p_N.z();
  FollowPlan plan{plan_to_slot(from, *leader_, order.offset, limits_, options_.horizon)};
  demanded_.emplace().assign(plan.plan);
  const Vec2 ahead = geo::horizontal(
      plan.plan[std::min<std::size_t>(kAhead, plan.plan.size() - 1)].p_N - in.nav->p_N);
  command.guidance = zones_.keep_out(std::move(plan), geo::bearing(ahead), *in.nav,
                                     command.altitude_msl);
  out.command = std::move(command);
}

void Wingman::report(const AgentInput& in, AgentOutput& out) {
  if (in.now < next_report_) return;
  next_report_ =
      std::max(next_report_ + Time::from_seconds(options_.report_period), in.now);
  const auto send = [&](EntityId to, auto content) {
    Message message;
    message.to = to;
    message.content = std::move(content);
    out.outbox.push_back(std::move(message));
  };
  send(station_, AircraftReport{*in.nav, limits_, has_task_ ? task_.number : 0, done_,
                                obeys_orders(in.autopilot), zones_.changes_known()});
  if (const auto* route = std::get_if<FlyRoute>(&task_.what))
    for (const EntityId id : route->report_to) send(id, TeamPosition{self_, *in.nav});
}

}  // namespace skein::reasoning
