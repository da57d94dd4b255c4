#include "layer/reasoning/team/wingman.h"

#include <algorithm>
#include <cmath>

#include "layer/reasoning/agent/altitude.h"

namespace skein::reasoning {
namespace {

// On the air: ids, time and content as fixed-point numbers.
constexpr int kReportBytes = 48;
constexpr int kPositionBytes = 36;
constexpr double kTurnRateLimit = 0.6;  // faster is noise of two positions [rad/s]
constexpr double kStaleLeader = 5;      // two positions this far apart say no turn [s]
constexpr int kPlanPoints = 9;
constexpr double kSpeedReserve = 1;   // for gusts of the leader [m/s]
constexpr double kTurnReserve = 0.8;  // of the lateral acceleration, for turns of a slot

}  // namespace

PlanPoint slot_at(const NavEstimate& leader, double turn_rate, const Vec2& offset,
                  double at) {
  const Vec2 velocity = geo::horizontal(leader.v_N);
  const double course = geo::bearing(velocity), speed = velocity.norm();
  const double turned = turn_rate * at;
  // Chord of the arc: speed at sin(turned/2) / (turned/2), along the mean course.
  const double half = turned / 2;
  const double chord = speed * at * (std::abs(half) < 1e-6 ? 1 : std::sin(half) / half);
  const Vec2 forward = geo::unit(course + turned);
  const Vec2 right = geo::turned_right(forward);
  const Vec2 p = geo::horizontal(leader.p_N) + chord * geo::unit(course + half) +
                 offset.x() * forward + offset.y() * right;
  const Vec2 v =
      speed * forward + turn_rate * (offset.x() * right - offset.y() * forward);
  return {leader.time + Time::from_seconds(at),
          Vec3(p.x(), p.y(), leader.p_N.z() + at * leader.v_N.z()),
          Vec3(v.x(), v.y(), leader.v_N.z())};
}

double bearable_turn_rate(const NavEstimate& leader, double turn_rate, const Vec2& offset,
                          const FlightLimits& limits, double wind_speed) {
  const double speed = geo::horizontal(leader.v_N).norm();
  double most = std::abs(turn_rate);
  // Outside of the turn a slot is faster by the turn rate times its distance, inside
  // slower.
  const double outside = turn_rate > 0 ? -offset.y() : offset.y();
  const double reserve = (outside > 0 ? limits.fastest - speed : speed - limits.slowest) -
                         wind_speed - kSpeedReserve;
  if (outside != 0) most = std::min(most, std::max(reserve, 0.0) / std::abs(outside));
  if (limits.slowest > 0) {
    const double lateral =
        kTurnReserve * limits.airspeed * limits.airspeed / limits.turn_radius;
    most = std::min(most, lateral / std::max(speed + wind_speed, 1.0));
  }
  return std::copysign(most, turn_rate);
}

Wingman::Wingman(const WingmanOptions& options, EntityId self, EntityId station,
                 const FlightLimits& limits, const Terrain& map)
    : options_(options),
      self_(self),
      station_(station),
      limits_(limits),
      map_(map),
      execution_(options.safety_zone) {}

void Wingman::step(const AgentInput& in, AgentOutput& out) {
  listen(in, out);
  if (!in.nav) return;
  if (const auto* order = std::get_if<FollowLeader>(&task_.what); order && has_task_)
    follow(*order, in, out);
  else if (const auto* route = std::get_if<FlyRoute>(&task_.what); route && task_is_new_)
    lead(*route, out);
  done_ = done_ || (std::holds_alternative<FlyRoute>(task_.what) && !task_is_new_ &&
                    in.autopilot.done);
  task_is_new_ = false;
  if (auto event = execution_.check(in.now, self_, in.autopilot))
    out.events.push_back(*std::move(event));
  report(in, out);
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
      out.events.push_back({in.now, self_, "task", leads ? "leads" : "follows"});
    } else if (const auto* told = std::get_if<TeamPosition>(&message.content)) {
      const auto* order = std::get_if<FollowLeader>(&task_.what);
      if (!order || told->aircraft != order->leader) continue;
      if (leader_ && told->nav.time <= leader_->time) continue;  // overtaken
      leader_turn_rate_ = 0;
      if (leader_) {
        const double since = (told->nav.time - leader_->time).seconds();
        const double turned = geo::wrap_pi(geo::bearing(geo::horizontal(told->nav.v_N)) -
                                           geo::bearing(geo::horizontal(leader_->v_N)));
        if (since < kStaleLeader)
          leader_turn_rate_ = std::clamp(turned / since, -kTurnRateLimit, kTurnRateLimit);
      }
      leader_ = told->nav;
      leader_is_new_ = true;
    }
  }
}

void Wingman::lead(const FlyRoute& route, AgentOutput& out) const {
  AutopilotCommand command;
  FlyWaypoints way;
  way.laps = route.laps;
  const double altitude = highest_along(map_, route.points) + options_.altitude_agl;
  for (const Vec2& point : route.points) way.points.push_back({point, altitude});
  command.guidance = std::move(way);
  command.altitude_msl = altitude;
  out.command = std::move(command);
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
  if (!leader_is_new_) return;
  leader_is_new_ = false;
  // From where the leader was heard of to the horizon: the follower is somewhere beside.
  const double age = (in.now - leader_->time).seconds();
  FollowPlan plan;
  const double turn_rate = bearable_turn_rate(*leader_, leader_turn_rate_, order.offset,
                                              limits_, in.nav->wind_N.norm());
  for (int k = 0; k < kPlanPoints; ++k)
    plan.plan.push_back(slot_at(*leader_, turn_rate, order.offset,
                                (age + options_.horizon) * k / (kPlanPoints - 1)));
  command.guidance = std::move(plan);
  out.command = std::move(command);
}

void Wingman::report(const AgentInput& in, AgentOutput& out) {
  if (in.now < next_report_) return;
  next_report_ =
      std::max(next_report_ + Time::from_seconds(options_.report_period), in.now);
  const auto send = [&](EntityId to, int bytes, auto content) {
    Message message;
    message.to = to;
    message.size_bytes = bytes;
    message.content = std::move(content);
    out.outbox.push_back(std::move(message));
  };
  send(station_, kReportBytes,
       AircraftReport{*in.nav, limits_, has_task_ ? task_.number : 0, done_,
                      obeys_orders(in.autopilot)});
  if (const auto* route = std::get_if<FlyRoute>(&task_.what))
    for (const EntityId id : route->tell)
      send(id, kPositionBytes, TeamPosition{self_, *in.nav});
}

}  // namespace skein::reasoning
