#include "skein/layer/reasoning/agent/monitor_agent.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "skein/base/math.h"
#include "skein/layer/reasoning/agent/altitude.h"
#include "skein/model/path/path_geometry.h"
#include "skein/model/path/point_path.h"
#include "skein/model/path/wind_triangle.h"

namespace skein::reasoning {
namespace {

// On the air: ids, time and content as fixed-point numbers.
constexpr double kPathReserve = 1.1;  // of turn radii over ground: room to correct
constexpr double kLineAhead = 3;      // pursuit point of a line, flight time ahead [s]
constexpr double kLineJoin = 2;       // a line begins this near to its start [turn radii]
constexpr double kSamePlace = 1;      // nearer is the same place [m]
constexpr double kLineEnd = 20;       // and ends this far before its end [m]

const char* name_of(const decltype(Task::what)& what) {
  constexpr std::array kNames = {"loiter",     "fly to",    "follow edge",  "follow line",
                                 "fly course", "fly route", "follow leader"};
  static_assert(kNames.size() == std::variant_size_v<decltype(Task::what)>);
  return kNames[what.index()];
}

Path straight_path(const std::vector<Vec2>& points) {
  Path path;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const Vec2 d = points[i + 1] - points[i];
    if (d.norm() > 0) path.push_back({points[i], geo::bearing(d), d.norm(), 0});
  }
  return path;
}

}  // namespace

MonitorAgent::MonitorAgent(const MonitorAgentOptions& options, EntityId self,
                           EntityId coordinator, const FlightLimits& limits,
                           const Terrain& map, std::span<const Zone> zones)
    : options_(options),
      self_(self),
      coordinator_(coordinator),
      limits_(limits),
      map_(map),
      zones_(options.avoidance, limits, zones, self),
      returns_(options.avoidance, limits, self, map),
      execution_(options.safety_zone) {}

void MonitorAgent::step(const AgentInput& in, AgentOutput& out) {
  for (const Message& message : in.inbox)
    if (const auto* task = std::get_if<Task>(&message.content)) take_task(*task, in, out);
  const bool news = zones_.listen(in, out);
  if (!in.nav) return;
  if (!home_) home_ = geo::horizontal(in.nav->p_N);
  take_samples(in, out);

  returns_.step(in, *home_, zones_.zones(), news, out);

  const Vec2 place = geo::horizontal(in.nav->p_N);
  const double up = map_.elevation_msl(place) + options_.altitude_agl;
  if (zones_.keeps_on_ground(in, up) || launch_.takes_off(in, up, out)) {
    report(in, out);
    return;
  }
  altitude_msl_ = altitude_over(map_, place, geo::horizontal(in.nav->v_N),
                                options_.altitude_agl, limits_.climb_rate);
  const Setpoint next = next_setpoint(in, out);
  AutopilotCommand command;
  command.guidance = zones_.keep_out(next.guidance, next.course, *in.nav, altitude_msl_);
  deflected_ = zones_.deflecting();
  zones_.look(in, out);
  command.altitude_msl = altitude_msl_;
  out.command = std::move(command);
  if (auto event = execution_.check(in.now, self_, in.autopilot))
    out.events.push_back(*std::move(event));
  report(in, out);
}

void MonitorAgent::take_task(const Task& task, const AgentInput& in, AgentOutput& out) {
  if (has_task_ && task.number <= task_.number) return;
  if (std::holds_alternative<FlyRoute>(task.what) ||
      std::holds_alternative<FollowLeader>(task.what)) {
    out.events.push_back({in.now, self_, "task-refused",
                          fmt::format("{}: not for this agent", name_of(task.what))});
    return;
  }
  task_ = task;
  has_task_ = true;
  done_ = joined_ = lost_ = false;
  moved_.reset();
  path_.clear();
  along_ = 0;
  follower_.reset();
  if (const auto* edge = std::get_if<FollowEdge>(&task.what)) {
    FollowEdge own = *edge;
    own.angle = options_.edge_angle.value_or(edge->angle);
    follower_.emplace(options_.edge, own);
  }
  if (const auto* line = std::get_if<FollowLine>(&task.what))
    path_ = straight_path(line->points);
  out.events.push_back({in.now, self_, "task",
                        fmt::format("task {}: {}", task.number, name_of(task.what))});
}

void MonitorAgent::take_samples(const AgentInput& in, AgentOutput& out) {
  const NavEstimate& nav = *in.nav;
  const Vec2 velocity = geo::horizontal(nav.v_N);
  for (const SensorSample& sample : in.samples) {
    if (const auto* fire = std::get_if<FireSample>(&sample)) {
      // Where the aircraft was when the sensor looked.
      const double ago = (nav.time - fire->time).seconds();
      FireReading reading{fire->time, self_,
                          geo::horizontal(nav.p_N) - ago * velocity +
                              fire->look_ahead * geo::unit(nav.heading),
                          nav.position_sd, fire->inside};
      if (follower_) follower_->add(reading, geo::bearing(velocity));
      Message message;
      message.to = coordinator_;
      message.content = reading;
      out.outbox.push_back(std::move(message));
      out.records.emplace_back(reading);
    } else if (const auto* edge = std::get_if<EdgeSample>(&sample)) {
      const double ago = (nav.time - edge->time).seconds();
      if (follower_) follower_->add(*edge, geo::horizontal(nav.p_N) - ago * velocity);
    }
  }
}

void MonitorAgent::report(const AgentInput& in, AgentOutput& out) {
  if (next_report_ && in.now < *next_report_) return;
  // Even spacing, also when steps do not fall on the period.
  const Time period = Time::from_seconds(options_.report_period);
  next_report_ = std::max(next_report_.value_or(in.now) + period, in.now);
  Message message;
  message.to = coordinator_;
  message.content = AircraftReport{*in.nav,
                                   limits_,
                                   has_task_ ? task_.number : 0,
                                   done_,
                                   obeys_orders(in.autopilot),
                                   zones_.changes_known()};
  out.outbox.push_back(std::move(message));
}

MonitorAgent::Setpoint MonitorAgent::next_setpoint(const AgentInput& in,
                                                   AgentOutput& out) {
  if (!has_task_) return circle_at(allowed(*home_, in, out), *in.nav);
  if (const auto* order = std::get_if<FlyTo>(&task_.what))
    return fly_to(allowed(order->point, in, out), in);
  if (follower_) return follow_edge(in, out);
  if (const auto* order = std::get_if<FollowLine>(&task_.what))
    return follow_line(*order, in);
  if (const auto* order = std::get_if<FlyCourse>(&task_.what))
    return {HoldCourse{order->course}, order->course};
  return circle_at(allowed(std::get<Loiter>(task_.what).centre, in, out), *in.nav);
}

// A task's place, or the nearest one that no zone forbids.
Vec2 MonitorAgent::allowed(const Vec2& place, const AgentInput& in, AgentOutput& out) {
  const Vec2 instead = zones_.allowed(place, *in.nav, altitude_msl_);
  const Vec2 before = moved_.value_or(place);
  if ((instead - before).norm() <= kSamePlace) return before;
  moved_ = instead;
  path_.clear();
  out.events.push_back(
      {in.now, self_, "task-moved",
       instead == place
           ? std::string("no zone forbids the place of the task any more")
           : fmt::format("the place of the task lies in a no-fly zone: {:.0f} m north, "
                         "{:.0f} m east instead",
                         instead.x(), instead.y())});
  return instead;
}

MonitorAgent::Setpoint MonitorAgent::circle_at(const Vec2& centre,
                                               const NavEstimate& nav) const {
  const double radius =
      kPathReserve *
      model::ground_turn_radius(limits_.turn_radius, limits_.airspeed, nav.wind_N.norm());
  const Vec2 out = geo::horizontal(nav.p_N) - centre;
  // Tangential on the circle, straight to it from afar.
  const double course =
      geo::bearing(out) + geo::kPi / 2 + math::atan2(out.norm() - radius, radius);
  return {Circle{centre, radius, true}, course};
}

MonitorAgent::Setpoint MonitorAgent::fly_to(const Vec2& point, const AgentInput& in) {
  const NavEstimate& nav = *in.nav;
  const Vec2 position = geo::horizontal(nav.p_N);
  const Vec2 velocity = geo::horizontal(nav.v_N);
  if (!path_.empty() && !deflected_ && in.autopilot.done) done_ = true;
  if (done_) return circle_at(point, nav);

  bool plan = path_.empty() || deflected_ ||
              (nav.wind_N - path_wind_).norm() > options_.replan_wind;
  if (!plan) {
    const double window = 10 * velocity.norm();
    const auto at = model::project(path_, position, along_ - window, along_ + window);
    along_ = at.along;
    plan = std::abs(at.cross_track) > options_.replan_cross;
  }
  if (plan) {
    const double radius =
        kPathReserve * model::ground_turn_radius(limits_.turn_radius, limits_.airspeed,
                                                 nav.wind_N.norm());
    path_ = model::path_to_point({position, geo::bearing(velocity)}, point, radius);
    path_wind_ = nav.wind_N;
    along_ = 0;
    if (path_.empty()) {
      done_ = true;
      return circle_at(point, nav);
    }
  }
  const Vec2 ahead =
      model::pose_at(path_, along_ + 3 * velocity.norm()).position - position;
  return {FollowPath{path_}, geo::bearing(ahead)};
}

MonitorAgent::Setpoint MonitorAgent::follow_edge(const AgentInput& in, AgentOutput& out) {
  const double course = follower_->course(in.now, geo::horizontal(in.nav->p_N));
  if (follower_->lost() != lost_) {
    lost_ = !lost_;
    out.events.push_back(
        {in.now, self_, lost_ ? "edge-lost" : "edge-found",
         lost_ ? "has lost the fire's edge" : "has found the fire's edge again"});
  }
  return {HoldCourse{course}, course};
}

MonitorAgent::Setpoint MonitorAgent::follow_line(const FollowLine& order,
                                                 const AgentInput& in) {
  const NavEstimate& nav = *in.nav;
  const Vec2 position = geo::horizontal(nav.p_N);
  if (order.points.empty()) {
    done_ = true;
    return circle_at(*home_, nav);
  }
  if (path_.empty() || done_) {
    done_ = done_ ||
            (order.points.back() - position).norm() < kLineJoin * limits_.turn_radius;
    return circle_at(order.points.back(), nav);
  }
  const Vec2 to_start = order.points.front() - position;
  joined_ = joined_ || to_start.norm() < kLineJoin * limits_.turn_radius;
  if (!joined_) return {HoldCourse{geo::bearing(to_start)}, geo::bearing(to_start)};

  const double ahead =
      std::max(kLineAhead * geo::horizontal(nav.v_N).norm(), limits_.turn_radius);
  const auto at = model::project(path_, position, along_, along_ + 3 * ahead);
  along_ = at.along;
  if (at.remaining < kLineEnd) {
    done_ = true;
    return circle_at(order.points.back(), nav);
  }
  const double course =
      geo::bearing(model::pose_at(path_, along_ + ahead).position - position);
  return {HoldCourse{course}, course};
}

}  // namespace skein::reasoning
