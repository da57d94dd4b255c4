// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/trajectory/route_flight.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "skein/base/math.h"
#include "skein/layer/reasoning/trajectory/leg_plan.h"
#include "skein/layer/reasoning/trajectory/round_trip.h"
#include "skein/model/path/flight_plan.h"

namespace skein::reasoning {
namespace {

constexpr std::int64_t kMaxPoints = 500;  // of one command, but for whole laps
constexpr double kPlanAgain = 10;         // after the last try, at the earliest [s]
constexpr double kAimFor = 2;             // a detour is flown, then asked anew [s]
constexpr double kReached = 2;            // a point is, this near to it [turn radii]
constexpr double kMinReached = 20;        // and this near at least [m]
constexpr double kBeside = 6;             // of a corner, still passed [turn radii]

double reach(const FlightLimits& limits) {
  return std::max(kReached * limits.turn_radius, kMinReached);
}

bool same(const std::vector<FlyWaypoints::Waypoint>& a,
          const std::vector<FlyWaypoints::Waypoint>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const auto& x, const auto& y) { return x.point == y.point; });
}

}  // namespace

RouteFlight::RouteFlight(const Legs& legs, const FlightContext& context)
    : legs_(legs),
      context_(context),
      route_(round_trip(legs.points, legs.laps, legs.altitude_msl)),
      total_(static_cast<std::int64_t>(route_.points.size()) * route_.laps) {}

const Vec2& RouteFlight::point(std::int64_t index) const {
  const auto count = static_cast<std::int64_t>(route_.points.size());
  return route_.points[static_cast<std::size_t>(index % count)].point;
}

void RouteFlight::give(decltype(AutopilotCommand::guidance) guidance, AgentOutput& out) {
  given_.clear();
  by_sight_ = false;
  AutopilotCommand command;
  command.guidance = std::move(guidance);
  command.altitude_msl = legs_.altitude_msl;
  command.airspeed = legs_.airspeed ? legs_.airspeed : context_.ordered_airspeed;
  out.command = std::move(command);
}

// Whether the next point lies behind: beyond the line that halves the corner there.
bool RouteFlight::passed(const Vec2& position) const {
  const Vec2& corner = point(next_);
  const Vec2 off = position - corner;
  const double near = kBeside * std::max(context_.limits.turn_radius, kMinReached);
  if (next_ + 1 >= total_ || off.norm() > near) return false;
  const Vec2 in = (corner - from_).normalized();
  const Vec2 on = (point(next_ + 1) - corner).normalized();
  const Vec2 through = in + on;
  // Straight back: the onward leg begins when it has turned.
  if (through.norm() < 0.1) return off.norm() < reach(context_.limits);
  return off.dot(through) > 0;
}

void RouteFlight::keep_count(const AgentInput& in, ZoneMonitor& zones) {
  const Vec2 here = geo::horizontal(in.nav->p_N);
  const bool done = in.autopilot.done && obeys_orders(in.autopilot);
  const auto go_on = [&](std::int64_t to) {
    from_ = point(to - 1);
    next_ = to;
  };
  if (stage_ == Stage::kRoute) {
    while (next_ + 1 < until_ && passed(here)) go_on(next_ + 1);
    if (done) go_on(until_), stage_ = Stage::kNew;
  } else if (stage_ == Stage::kPlanned && done) {
    go_on(next_ + 1);
    stage_ = Stage::kNew;
  } else if (stage_ == Stage::kGuarded) {
    const Vec2 end = zones.detours(*in.nav).nearest_allowed(point(next_));
    if ((here - end).norm() > reach(context_.limits)) return;
    const double miss = (here - point(next_)).norm();
    const bool missed = zones.distance(point(next_)) < 0 || miss > reach(context_.limits);
    if (next_ + 1 == total_ && missed) missed_by_ = miss;
    go_on(next_ + 1);
    stage_ = Stage::kNew;
  }
}

void RouteFlight::step(const TrajectoryStep& step, AgentOutput& out) {
  const AgentInput& in = step.in;
  ZoneMonitor& zones = step.zones;
  zones.regard(*in.nav, legs_.altitude_msl);
  const bool changed = zones.take_change();
  if (stage_ == Stage::kDone) return stay(in, zones, out);
  const bool first = stage_ == Stage::kNew;
  if (first) from_ = geo::horizontal(in.nav->p_N);
  if (changed) reported_ = -1;
  // A refused plan is not flown: the old guidance goes on, through the zone perhaps.
  if (stage_ == Stage::kPlanned && in.command_fate.state == CommandFate::State::kRefused)
    stage_ = Stage::kGuarded;
  keep_count(in, zones);
  if (changed || must_choose(in, zones, step.off_plan)) choose(in, zones, out);
  if (stage_ == Stage::kGuarded) fly_guarded(in, zones, out);
}

bool RouteFlight::must_choose(const AgentInput& in, const ZoneMonitor& zones,
                              bool off_plan) const {
  const Vec2 here = geo::horizontal(in.nav->p_N);
  const bool inside = zones.distance(here) < 0;
  switch (stage_) {
    case Stage::kNew:
      return true;
    case Stage::kRoute:
      return inside;
    case Stage::kPlanned:
      return inside || (off_plan && in.now >= plan_again_);
    case Stage::kGuarded:
      return !inside && (in.now >= plan_again_ || !zones.blocks(here, point(next_)));
    case Stage::kDone:
      return false;
  }
  return false;
}

// Points in zones are left out, but for the last one: near there it stays. Where all
// points between are left out, the same point is not flown to twice in place.
void RouteFlight::leave_out(const AgentInput& in, const ZoneMonitor& zones,
                            AgentOutput& out) {
  for (; next_ < total_; ++next_) {
    const bool forbidden = zones.distance(point(next_)) < 0;
    const bool there = next_ > 0 && point(next_) == from_;
    if (forbidden ? next_ + 1 == total_ : !there) return;
    if (forbidden) report_left_out(in.now, out);
  }
}

void RouteFlight::report_left_out(Time now, AgentOutput& out) const {
  const Vec2& p = point(next_);
  out.events.push_back({now, context_.self, EventKind::kPointLeftOut,
                        fmt::format("{:.0f} m north, {:.0f} m east lies in a no-fly "
                                    "zone",
                                    p.x(), p.y())});
}

void RouteFlight::choose(const AgentInput& in, ZoneMonitor& zones, AgentOutput& out) {
  aim_again_ = in.now;
  const Vec2 here = geo::horizontal(in.nav->p_N);
  leave_out(in, zones, out);
  if (next_ >= total_) {
    stage_ = Stage::kDone;
    return stay(in, zones, out);
  }
  if (zones.distance(here) < 0) {
    stage_ = Stage::kGuarded;
    plan_again_ = in.now;
    return;
  }
  // The points that free legs lead to. After a lap legs repeat, but for the first one.
  const auto lap = static_cast<std::int64_t>(route_.points.size());
  std::int64_t free = next_;
  const Vec2* from = &here;
  while (free < total_ && free <= next_ + lap && !zones.blocks(*from, point(free)))
    from = &point(free++);
  if (free > next_ + lap) free = total_;
  if (free > next_) return fly_route(here, free, out);
  plan_again_ = in.now + Time::from_seconds(kPlanAgain);
  if (zones.distance(point(next_)) < 0) {
    // The last point: no route leads there.
    if (std::exchange(reported_, next_) != next_) report_left_out(in.now, out);
  } else if (fly_planned(in, zones, out)) {
    return;
  }
  stage_ = Stage::kGuarded;
}

void RouteFlight::fly_route(const Vec2& here, std::int64_t free, AgentOutput& out) {
  const auto lap = static_cast<std::int64_t>(route_.points.size());
  FlyWaypoints route;
  if (next_ % lap == 0 && free == total_) {
    route = route_;
    route.laps = static_cast<int>((total_ - next_) / lap);
    until_ = total_;
  } else {
    until_ = std::min(free, next_ + kMaxPoints);
    for (std::int64_t k = next_; k < until_; ++k)
      route.points.push_back({point(k), legs_.altitude_msl});
  }
  // Autopilots take the same waypoints for a repetition, and go on with what they fly or
  // have flown. Another lap begins with a further point on the leg to its first.
  if (begins_ != next_ && same(given_, route.points))
    route.points.insert(route.points.begin(),
                        {(here + point(next_)) / 2, legs_.altitude_msl});
  begins_ = next_;
  stage_ = Stage::kRoute;
  auto points = route.points;
  give(std::move(route), out);
  given_ = std::move(points);
}

void RouteFlight::report(FlightProgress& progress) const {
  progress.done = done();
  progress.by_sight = stage_ == Stage::kGuarded;
  progress.passed = static_cast<std::size_t>(next_);
  if (progress.done) progress.ending = ending();
}

std::string_view RouteFlight::change() const {
  switch (stage_) {
    case Stage::kPlanned:
      return "a leg planned around no-fly zones";
    case Stage::kGuarded:
      return "around zones by sight";
    case Stage::kNew:
    case Stage::kRoute:
    case Stage::kDone:
      break;
  }
  return {};
}

std::string RouteFlight::ending() const {
  if (missed_by_ == 0) return "the last point has been passed";
  return fmt::format(
      "the last point was left out, {:.0f} m from it: no-fly zones leave "
      "no room there",
      missed_by_);
}

bool RouteFlight::fly_planned(const AgentInput& in, const ZoneMonitor& zones,
                              AgentOutput& out) {
  if (!context_.planner) return false;
  const Vec2 here = geo::horizontal(in.nav->p_N), goal = point(next_);
  const Vec2 on = next_ + 1 < total_ ? Vec2(point(next_ + 1) - goal) : Vec2(goal - here);
  const PlannedPath path = plan_leg(legs_, context_, in, zones, goal, geo::bearing(on));
  if (path.plan.empty()) {
    if (std::exchange(reported_, next_) != next_)
      out.events.push_back({in.now, context_.self, EventKind::kNoPath,
                            fmt::format("{}: {}; flies around by sight",
                                        name_of(path.outcome), path.reason)});
    return false;
  }
  reported_ = -1;
  out.events.push_back({in.now, context_.self, EventKind::kPlanned,
                        fmt::format("a path of {:.0f} s around no-fly zones",
                                    model::duration(path.plan))});
  stage_ = Stage::kPlanned;
  give(FollowPlan{model::sample(path.plan)}, out);
  return true;
}

void RouteFlight::fly_guarded(const AgentInput& in, ZoneMonitor& zones,
                              AgentOutput& out) {
  const Vec2 here = geo::horizontal(in.nav->p_N);
  if (in.now >= aim_again_) {
    aim_ = zones.detours(*in.nav).detour(here, point(next_)).front();
    aim_again_ = in.now + Time::from_seconds(kAimFor);
  }
  const double course = geo::bearing(aim_ - here);
  give(zones.keep_out(HoldCourse{course}, course, *in.nav, legs_.altitude_msl), out);
  by_sight_ = true;
}

void RouteFlight::stay(const AgentInput& in, ZoneMonitor& zones, AgentOutput& out) {
  if (zones.zones().empty() && !stays_ && !by_sight_) return;
  const Vec2 here = geo::horizontal(in.nav->p_N);
  const Vec2 place = zones.allowed(point(total_ - 1), *in.nav, legs_.altitude_msl);
  const bool was_deflecting = zones.deflecting();
  // Along the circle there, straight to it from afar.
  const double radius = context_.limits.turn_radius;
  const Vec2 off = here - place;
  const double course =
      geo::bearing(off) + geo::kPi / 2 + math::atan2(off.norm() - radius, radius);
  auto guidance =
      zones.keep_out(HoldPosition{place}, course, *in.nav, legs_.altitude_msl);
  if (!zones.deflecting() && !was_deflecting && !by_sight_ &&
      place == stays_.value_or(point(total_ - 1)))
    return;
  stays_ = place;
  give(std::move(guidance), out);
}

}  // namespace skein::reasoning
