#include "skein/mixed/flight_director.h"

#include <fmt/format.h>

#include <utility>

namespace skein::mixed {
namespace {

const Time kAgain = Time::from_seconds(3);    // after a denial
const Time kSettled = Time::from_seconds(5);  // on the ground: then motors off
constexpr double kArrival = 8;  // from the altitude of a take-off, counted as there [m]

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
  control_.hear(change);
  switch (change.kind) {
    case LinkChange::Kind::kUp:
      up_ = true;
      pending_ = 0;
      again_at_ = Time();
      return;
    case LinkChange::Kind::kDown:
      up_ = false;
      reached_ = false;
      return;
    case LinkChange::Kind::kRebooted:
      begin_again();
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
  if (answer.outcome != RequestAnswer::Outcome::kNoAnswer) control_.denied();
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

// Given back: what is wanted of it is asked for from the beginning.
void FlightDirector::begin_again() {
  asked_ = started_ = reached_ = false;
  pending_ = 0;
  again_at_ = Time();
}

Result<void> FlightDirector::hand_back(std::vector<VehicleEvent>& events) {
  if (!up_)
    return Error{ErrorCode::kBadInput, "", "its link is down.", "Try when it is up."};
  if (auto given = control_.hand_back(); !given) return given;
  begin_again();
  events.push_back({"handed-back", "by a command"});
  return {};
}

void FlightDirector::ask(Time now, const VehicleRequest& request, VehiclePort& port) {
  asked_ = true;
  pending_ = ++number_;
  again_at_ = now;
  control_.sent(request);
  port.send(pending_, request);
}

void FlightDirector::step(Time now, const VehicleCondition& condition,
                          double altitude_msl, bool knows_position, VehiclePort& port,
                          std::vector<VehicleEvent>& events) {
  if (!up_ || goal_ == Goal::kNone) return;
  if (control_.step(now, condition, goal_ == Goal::kLand, events)) begin_again();
  if (control_.is_taken()) {
    reached_ = false;
    return;
  }
  if (!knows_position && !condition.on_ground) return;
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
