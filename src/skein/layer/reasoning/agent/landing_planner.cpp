// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/agent/landing_planner.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "skein/layer/reasoning/trajectory/steering_flight.h"

namespace skein::reasoning {
namespace {

constexpr double kNear = 3000, kNearTime = 120;  // of the place: it takes part [m], [s]
constexpr double kApproachHeight = 40;           // above the ground [m]
constexpr double kApproachSlope = 0.09;          // [rad]
constexpr double kApproachTime = 25;             // in line before it comes down [s]
constexpr double kHoverApproach = 150;           // of what comes down on the spot [m]
constexpr double kCommitted = 60;                // height of who breaks off no more [m]
constexpr double kBesides = 4;      // separations, between approach and holding circle
constexpr double kAtApproach = 30;  // counts as there, besides its circle [m]
constexpr double kTurns = 40;       // that a landing takes besides its path [s]
constexpr double kDay = 86400;      // of flight, while the autopilot says nothing [s]
constexpr double kMinSpeed = 1;     // [m/s]

// Where a failsafe lands, or the task wants to; none: nowhere.
std::optional<Vec2> landing_place(const FlightIntent& given, const TaskStep& step) {
  const FailsafeReaction reaction = step.in.autopilot.reaction;
  if (reaction == FailsafeReaction::kLand) return step.safety.home();
  if (!obeys_orders(step.in.autopilot)) return std::nullopt;
  const auto* landing = std::get_if<Landing>(&given.what);
  return landing ? std::optional(landing->place) : std::nullopt;
}

}  // namespace

void LandingPlanner::send(AgentOutput& out) {
  for (Message& message : messages_) out.outbox.push_back(std::move(message));
  messages_.clear();
}

void LandingPlanner::listen(const AgentInput& in, const RadioQuality& radio,
                            AgentOutput& out) {
  queue_.listen(in.now, in.inbox);
  if (!in.nav || !has_flown_ || !in.autopilot.on_ground) return;
  leg_ = Leg::kNone;
  reason_ = {};
  queue_.stand(in.now, in.nav->p_N, radio.loss, radio.delay, messages_);
  send(out);
}

// Level flight in line, the slope down to the ground and the roll-out.
double LandingPlanner::approach_length() const {
  if (context_.limits.slowest <= 0) return kHoverApproach;
  return kApproachHeight / kApproachSlope + kApproachTime * context_.limits.airspeed;
}

double LandingPlanner::time_needed(const LandingTurn& turn,
                                   const NavEstimate& nav) const {
  const double speed = std::max(context_.limits.airspeed - nav.wind_N.norm(), kMinSpeed);
  const Vec2 approach = place_ - approach_length() * geo::unit(turn.course);
  const double down = std::max(0.0, -nav.p_N.z() - ground_ - kApproachHeight) /
                      std::max(context_.limits.sink_rate, kMinSpeed / 2);
  const double there =
      leg_ == Leg::kApproach ? 0 : (geo::horizontal(nav.p_N) - approach).norm() / speed;
  return there + down + approach_length() / speed + kTurns;
}

void LandingPlanner::leave(AgentOutput& out) {
  leg_ = Leg::kNone;
  reason_ = {};
  queue_.leave(messages_);
  send(out);
}

const FlightIntent* LandingPlanner::plan(const FlightIntent* given, const TaskStep& step,
                                         const RadioQuality& radio, AgentOutput& out) {
  has_flown_ = true;
  queue_.fly();
  const NavEstimate& nav = *step.in.nav;
  const std::optional<Vec2> place = landing_place(*given, step);
  const double speed = std::max(context_.limits.airspeed, kMinSpeed);
  const bool near = place && (geo::horizontal(nav.p_N) - *place).norm() <
                                 std::max(kNear, kNearTime * speed);
  if (!place || (leg_ != Leg::kNone && *place != place_)) leave(out);
  if (!place) return given;
  const bool by_itself = !obeys_orders(step.in.autopilot);
  if (!near) {
    // Not down yet, which a landing begins with.
    const auto* landing = std::get_if<Landing>(&given->what);
    if (by_itself || !landing || leg_ != Leg::kNone) return given;
    own_ = {0, Circling{landing->place, landing->altitude_msl}};
    reason_ = "flies home";
    return &own_;
  }
  place_ = *place;
  ground_ = context_.map->elevation_msl(place_);
  LandingStep at;
  at.now = step.in.now;
  at.place = place_;
  at.ground_msl = ground_;
  at.p_N = nav.p_N;
  at.wind = nav.wind_N;
  at.endurance = step.in.autopilot.endurance.value_or(kDay);
  at.lasts = time_needed(turn_, nav);
  at.loss = radio.loss;
  at.delay = radio.delay;
  at.emergency = by_itself;
  at.committed = approaches() && -nav.p_N.z() - ground_ < kCommitted;
  turn_ = queue_.step(at, messages_);
  send(out);
  if (by_itself) {
    leg_ = Leg::kNone;
    return given;
  }
  return fly(turn_, step, out);
}

void LandingPlanner::begin(Leg leg, const TaskStep& step, AgentOutput& out) {
  if (leg == leg_) return;
  leg_ = leg;
  if (leg == Leg::kHold)
    out.events.push_back(
        {step.in.now, context_.self, EventKind::kLandingWait,
         fmt::format("waits for its turn to land, {:.0f} m above the ground",
                     turn_.altitude_msl - ground_)});
  else if (leg == Leg::kToApproach)
    out.events.push_back(
        {step.in.now, context_.self, EventKind::kLandingTurn, "has its turn to land"});
}

const FlightIntent* LandingPlanner::fly(const LandingTurn& turn, const TaskStep& step,
                                        AgentOutput& out) {
  const NavEstimate& nav = *step.in.nav;
  const double radius = wide_radius(context_.limits, nav.wind_N);
  const Vec2 along = geo::unit(turn.course);
  if (!turn.lands) {
    begin(Leg::kHold, step, out);
    const double ahead = 2 * radius + kBesides * horizontal_;
    own_ = {0, Circling{place_ + ahead * along, turn.altitude_msl}};
    reason_ = "waits for its turn to land";
    return &own_;
  }
  const Vec2 approach = place_ - approach_length() * along;
  if (!approaches()) {
    begin(Leg::kToApproach, step, out);
    if ((geo::horizontal(nav.p_N) - approach).norm() > 1.5 * radius + kAtApproach) {
      own_ = {0, Circling{approach, turn.altitude_msl}};
      reason_ = "flies to its approach";
      return &own_;
    }
    begin(Leg::kApproach, step, out);
    own_ = {step.intents.next(),
            Landing{place_, turn.altitude_msl, turn.course, approach_length()}};
    reason_ = "lands";
  }
  return &own_;
}

}  // namespace skein::reasoning
