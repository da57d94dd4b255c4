#include "skein/mixed/flight_director.h"

#include <fmt/format.h>

#include <utility>

namespace skein::mixed {
namespace {

const Time kAgain = Time::from_seconds(3);    // after a denial
const Time kSettled = Time::from_seconds(5);  // on the ground: then motors off
constexpr double kArrival = 8;  // from the altitude of a take-off, counted as there [m]

bool by_sticks(VehicleMode mode) {
  return mode == VehicleMode::kManual || mode == VehicleMode::kStabilized;
}

}  // namespace

void FlightDirector::set_goal(Goal goal) {
  if (goal_ == goal) return;
  goal_ = goal;
  asked_ = started_ = reached_ = done_ = false;
  pending_ = 0;
  again_at_ = Time();
  denied_.clear();
}

void FlightDirector::take_off(const TakeOffRequest& request) {
  take_off_ = request;
  set_goal(Goal::kTakeOff);
}

void FlightDirector::fly() {
  // What is commanded while it takes off waits until it is up.
  if (goal_ == Goal::kTakeOff && !done_) return;
  set_goal(Goal::kFly);
}

void FlightDirector::land(const LandRequest& request) {
  if (goal_ == Goal::kLand && land_.point == request.point) return;
  land_ = request;
  goal_ = Goal::kNone;  // elsewhere: it begins anew
  set_goal(Goal::kLand);
}

void FlightDirector::hear(const LinkChange& change) {
  switch (change.kind) {
    case LinkChange::Kind::kUp:
      came_up_ = up_ = true;
      pending_ = 0;
      again_at_ = Time();
      return;
    case LinkChange::Kind::kDown:
      up_ = false;
      reached_ = false;
      return;
    case LinkChange::Kind::kRebooted:
      came_up_ = true;
      pending_ = 0;
      asked_ = started_ = reached_ = false;
      return;
    case LinkChange::Kind::kMismatch:
    case LinkChange::Kind::kDuplicate:
      return;
  }
}

void FlightDirector::hear(const RequestAnswer& answer, Time now,
                          std::vector<VehicleEvent>& events) {
  if (answer.number == 0 || answer.number != pending_) return;
  pending_ = 0;
  if (answer.outcome == RequestAnswer::Outcome::kAccepted) {
    started_ = true;
    denied_.clear();
    again_at_ = now + kAgain;  // its mode follows a moment later
    return;
  }
  again_at_ = now + kAgain;
  if (answer.text == denied_) return;
  denied_ = answer.text;
  const char* kind = goal_ == Goal::kTakeOff ? "arming-denied" : "request-denied";
  events.push_back({kind, fmt::format("{}: {}", name_of(answer.outcome), answer.text)});
}

// Whether a mode is one that what was asked for goes through.
bool FlightDirector::is_wanted(VehicleMode mode) const {
  switch (goal_) {
    case Goal::kNone:
      return true;
    case Goal::kTakeOff:
      return mode == VehicleMode::kTakeOff || mode == VehicleMode::kGuided ||
             (done_ && mode == VehicleMode::kHold);
    case Goal::kFly:
      return mode == VehicleMode::kGuided;
    case Goal::kLand:
      return mode == VehicleMode::kLand || (!hovers_ && mode == VehicleMode::kMission);
  }
  return true;
}

void FlightDirector::watch_mode(const VehicleCondition& condition,
                                std::vector<VehicleEvent>& events) {
  const bool changed = condition.mode_name != last_name_;
  const bool unseen = std::exchange(came_up_, false);
  const VehicleMode before = last_mode_;
  last_mode_ = condition.mode;
  last_name_ = condition.mode_name;
  if (is_wanted(condition.mode)) {
    if (std::exchange(taken_, false))
      events.push_back({"handed-back", condition.mode_name});
    return;
  }
  const bool pilot = by_sticks(condition.mode);
  if (unseen && !pilot) {
    taken_ = false;
    return;
  }
  // Sticks always count; else it can be taken only from a mode that was asked for. On the
  // ground it is nobody's.
  const bool takes = pilot ? !taken_ : changed && (reached_ || taken_);
  if (!takes || condition.on_ground) return;
  if (!taken_ || by_sticks(before) != pilot)
    events.push_back({pilot ? "pilot-took-over" : "mode-changed",
                      fmt::format("it flies in {} now", condition.mode_name)});
  taken_ = true;
  reached_ = false;
}

void FlightDirector::ask(Time now, const VehicleRequest& request, VehiclePort& port) {
  asked_ = true;
  pending_ = ++number_;
  again_at_ = now;
  port.send(pending_, request);
}

void FlightDirector::step(Time now, const VehicleCondition& condition,
                          double altitude_msl, VehiclePort& port,
                          std::vector<VehicleEvent>& events) {
  if (!up_) return;
  watch_mode(condition, events);
  if (taken_) return;
  switch (goal_) {
    case Goal::kNone:
      return;
    case Goal::kTakeOff:
      return step_take_off(now, condition, altitude_msl, port);
    case Goal::kFly:
      return step_flight(now, condition, port);
    case Goal::kLand:
      return step_landing(now, condition, port);
  }
}

void FlightDirector::step_take_off(Time now, const VehicleCondition& condition,
                                   double altitude_msl, VehiclePort& port) {
  const bool flies = condition.armed && !condition.on_ground;
  // In the air already: there is nothing to take off from.
  if (flies && !asked_) done_ = true;
  if (flies && altitude_msl >= take_off_.altitude_msl - kArrival) done_ = true;
  reached_ = flies && started_;
  if (done_) return set_goal(Goal::kFly);
  // That it is armed is told some time after it was accepted.
  if (!flies && started_ && !condition.armed && may_ask(now)) started_ = false;
  if (!started_ && may_ask(now)) ask(now, take_off_, port);
}

void FlightDirector::step_flight(Time now, const VehicleCondition& condition,
                                 VehiclePort& port) {
  reached_ = condition.mode == VehicleMode::kGuided && condition.armed;
  const bool flies = condition.armed && !condition.on_ground;
  if (flies && condition.mode != VehicleMode::kGuided && may_ask(now))
    ask(now, ModeRequest{VehicleMode::kGuided}, port);
}

void FlightDirector::step_landing(Time now, const VehicleCondition& condition,
                                  VehiclePort& port) {
  if (!condition.on_ground) on_ground_since_.reset();
  if (condition.on_ground && !on_ground_since_) on_ground_since_ = now;
  done_ = condition.on_ground && !condition.armed;
  if (done_) return;
  reached_ = started_ && is_wanted(condition.mode);
  if (condition.on_ground) {
    if (now - *on_ground_since_ >= kSettled && may_ask(now))
      ask(now, ArmRequest{false, false}, port);
  } else if (!reached_ && may_ask(now)) {
    ask(now, land_, port);
  }
}

}  // namespace skein::mixed
