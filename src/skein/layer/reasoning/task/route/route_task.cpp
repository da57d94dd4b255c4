// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/task/route/route_task.h"

#include <algorithm>

#include "skein/layer/reasoning/trajectory/altitude.h"

namespace skein::reasoning {
namespace {

// Of the range of speeds, for a leader: the rest is for followers, outside of turns and
// behind.
constexpr double kLeaderSpeed = 0.4;
constexpr std::size_t kUnrolled = 100;  // points that are left are listed up to these
constexpr double kReportPeriod = 1;     // of its position, to followers [s]

Legs legs_of(const FlightContext& context, const FlyRoute& order) {
  Legs legs;
  legs.points = order.points;
  legs.laps = order.laps;
  legs.altitude_msl = highest_along(*context.map, order.points) + context.altitude_agl;
  legs.ground_clearance = context.altitude_agl / 2;
  const FlightLimits& limits = context.limits;
  if (!order.report_to.empty() && limits.slowest > 0)
    legs.airspeed =
        std::min(limits.airspeed,
                 limits.slowest + kLeaderSpeed * (limits.fastest - limits.slowest));
  return legs;
}

}  // namespace

RouteTask::RouteTask(const FlightContext& context, const FlyRoute& order, bool lands)
    : self_(context.self), order_(order), lands_(lands), legs_(legs_of(context, order)) {}

const FlightIntent* RouteTask::plan(const TaskStep& step, AgentOutput& out) {
  report(step, out);
  const FlightProgress& flight = step.flight;
  const bool flies = intent_.number != 0 && flight.number == intent_.number;
  if (flies && !done_) {
    passed_ = begun_at_ + flight.passed;
    done_ = flight.done;
    if (done_)
      out.events.push_back({step.in.now, self_, EventKind::kRouteDone, flight.ending});
  }
  if (interrupted_) begin(step.intents.next());
  if (done_ && lands_) land(step);
  return &intent_;
}

// What is left of the route: as it was ordered, or what a pause has left.
void RouteTask::begin(std::uint32_t number) {
  interrupted_ = false;
  intent_.number = number;
  if (done_) {
    intent_.what = Circling{order_.points.back(), legs_.altitude_msl};
    return;
  }
  Legs legs = legs_;
  const FlyRoute left = this->left();
  legs.points = left.points;
  legs.laps = left.laps;
  begun_at_ = passed_;
  intent_.what = std::move(legs);
}

void RouteTask::interrupt() {
  if (done_) landing_ = false;
  interrupted_ = true;
}

// Point by point or, where these are many, in whole laps from the next point on.
FlyRoute RouteTask::left() const {
  const std::size_t lap = order_.points.size();
  const std::size_t total = lap * static_cast<std::size_t>(order_.laps);
  const std::size_t first = std::min(passed_, total - 1), count = total - first;
  if (first == 0) return order_;
  FlyRoute left;
  left.report_to = order_.report_to;
  const bool few = count <= std::max(kUnrolled, lap);
  left.laps = few ? 1 : static_cast<int>((count + lap - 1) / lap);
  for (std::size_t k = 0; k < (few ? count : lap); ++k)
    left.points.push_back(order_.points[(first + k) % lap]);
  return left;
}

TaskKind RouteTask::rest() const {
  return left();
}

TaskProgress RouteTask::progress(const AgentInput&) const {
  const std::size_t total = order_.points.size() * static_cast<std::size_t>(order_.laps);
  TaskProgress progress;
  progress.done = done_;
  progress.share = done_ ? 1 : static_cast<double>(passed_) / static_cast<double>(total);
  return progress;
}

void RouteTask::report(const TaskStep& step, AgentOutput& out) {
  const Time now = step.in.now;
  if (order_.report_to.empty() || (next_report_ && now < *next_report_)) return;
  next_report_ =
      std::max(next_report_.value_or(now) + Time::from_seconds(kReportPeriod), now);
  for (const EntityId id : order_.report_to) {
    Message message;
    message.to = id;
    message.content = TeamPosition{self_, *step.in.nav};
    out.outbox.push_back(std::move(message));
  }
}

void RouteTask::land(const TaskStep& step) {
  if (landing_) return;
  landing_ = true;
  const FlightSafety& safety = step.safety;
  intent_.number = step.intents.next();
  intent_.what = Landing{safety.began_on_ground() ? safety.home() : order_.points.front(),
                         legs_.altitude_msl};
}

}  // namespace skein::reasoning
