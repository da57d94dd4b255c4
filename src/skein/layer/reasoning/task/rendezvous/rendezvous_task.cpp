// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/task/rendezvous/rendezvous_task.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "skein/model/path/wind_triangle.h"
#include "skein/solve/target/timed_flight.h"

namespace skein::reasoning {
namespace {

constexpr double kLate = 1;       // later than asked for is late [s]
constexpr double kSlowest = 0.5;  // of cruise, for who can hover: still a flight
constexpr double kGap = 2;        // a later time that is tried instead [s]
constexpr int kTries = 30;

// Off its plan it makes another that is there in time.
PlannedTaskOptions there_in_time() {
  PlannedTaskOptions options;
  options.rejoins = false;
  return options;
}

}  // namespace

RendezvousTask::RendezvousTask(const FlightContext& context, const Rendezvous& order)
    : PlannedTask(context, there_in_time()), order_(order) {}

const FlightIntent* RendezvousTask::before(const TaskStep& step, AgentOutput& out) {
  if (late_by_ > kLate && std::abs(late_by_ - said_late_) > kLate) {
    said_late_ = late_by_;
    out.events.push_back(
        {step.in.now,
         context().self,
         EventKind::kLate,
         fmt::format("can be there {:.0f} s later than asked for", late_by_),
         {.value = late_by_}});
  }
  return nullptr;
}

PlannedTask::Part RendezvousTask::plan_part(const Start& start, const TaskStep&) {
  const Vec2 here = geo::horizontal(start.state.p_N);
  const Vec2 to = order_.point - here;
  const double course =
      order_.course.value_or(to.norm() > 1 ? geo::bearing(to) : start.state.heading);
  solve::TimedLeg leg;
  leg.from = start.state;
  leg.to = {{order_.point.x(), order_.point.y(), start.state.p_N.z()},
            model::heading_for_course(course, start.limits.airspeed, start.wind)
                .value_or(course)};
  leg.start = start.time;
  leg.limits = start.limits;
  leg.limits.slowest = std::max(leg.limits.slowest, kSlowest * leg.limits.airspeed);
  leg.wind = start.wind;
  const double asked = order_.time.seconds();
  solve::TimedFlight flight = solve::arrive_at(leg, asked);
  double time = asked;
  for (int k = 0; k < kTries && flight.plan.empty(); ++k) {
    if (flight.status == solve::TimedStatus::kNoConnection) break;
    time = std::max(
        {time + kGap, flight.earliest, std::isfinite(flight.next) ? flight.next : 0});
    flight = solve::arrive_at(leg, time);
  }
  Part part;
  part.plan = std::move(flight.plan);
  if (part.plan.empty())
    part.why_not =
        fmt::format("nothing leads there in a wind of {:.1f} m/s", start.wind.norm());
  late_by_ = time - asked;
  return part;
}

bool RendezvousTask::finish(const TaskStep& step, AgentOutput& out) {
  const double late = (step.in.now - order_.time).seconds();
  out.events.push_back(
      {step.in.now,
       context().self,
       EventKind::kArrived,
       fmt::format("at the rendezvous, {:.1f} s after the time asked for", late),
       {.value = late}});
  return true;
}

}  // namespace skein::reasoning
