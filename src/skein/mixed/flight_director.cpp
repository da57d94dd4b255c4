// SPDX-License-Identifier: Apache-2.0
#include "skein/mixed/flight_director.h"

#include <fmt/format.h>

#include <utility>

namespace skein::mixed {
namespace {

const Time kAgain = Time::from_seconds(3);    // after a denial
const Time kSettled = Time::from_seconds(5);  // on the ground: then motors off
const Time kSlowAgain = Time::from_seconds(15);
constexpr int kQuickTries = 20;                 // then it is asked more slowly
const Time kDisarmed = Time::from_seconds(20);  // after motors turned for nothing
const Time kStands = Time::from_seconds(20);    // after an accepted take-off
const Time kSaidAgain = Time::from_seconds(60);
constexpr std::size_t kMaxReasons = 50;
constexpr double kArrival = 8;  // from the altitude of a take-off, counted as there [m]

// The same reason with other numbers is the same.
std::string without_numbers(const std::string& text) {
  std::string reason;
  for (const char c : text) {
    const bool digit = c >= '0' && c <= '9';
    if (!digit)
      reason += c;
    else if (reason.empty() || reason.back() != '#')
      reason += '#';
  }
  return reason;
}

}  // namespace

void FlightDirector::set_goal(Goal goal) {
  if (goal_ == goal) return;
  goal_ = goal;
  asked_ = started_ = reached_ = done_ = false;
  pending_ = 0;
  again_at_ = Time();
  denied_.clear();
  denials_ = 0;
  disarm_ = false;
  stands_since_.reset();
}

void FlightDirector::take_off(const TakeOffRequest& request) {
  if (goal_ == Goal::kBringBack) {
    pending_event_ = "it was brought back and stays on the ground: " + brought_back_;
    return;
  }
  take_off_ = request;
  set_goal(Goal::kTakeOff);
}

void FlightDirector::fly() {
  // What is commanded while it takes off waits until it is up.
  if (goal_ == Goal::kTakeOff && !done_) return;
  if (goal_ == Goal::kBringBack) return;
  set_goal(Goal::kFly);
}

void FlightDirector::bring_back(const std::string& why) {
  if (goal_ == Goal::kBringBack) return;
  brought_back_ = why;
  set_goal(Goal::kBringBack);
  lands_next_ = not_back_said_ = false;
  not_back_.clear();
}

void FlightDirector::land(const LandRequest& request) {
  if (goal_ == Goal::kLand && land_.point == request.point) return;
  if (goal_ == Goal::kBringBack && (reached_ || done_)) return;
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
    started_ = accepted_ = true;
    denials_ = 0;
    again_at_ = now + kAgain;  // its mode follows a moment later
    return;
  }
  if (answer.outcome != RequestAnswer::Outcome::kNoAnswer) control_.denied();
  if (answer.outcome == RequestAnswer::Outcome::kWithdrawn) {
    control_.withdrawn();
    again_at_ = now + kAgain;
    return;
  }
  again_at_ = now + (++denials_ < kQuickTries ? kAgain : kSlowAgain);
  if (goal_ == Goal::kBringBack) return not_brought_back(answer.text, events);
  disarm_ = goal_ == Goal::kTakeOff && !armed_before_;
  refused(answer.text, now, events);
}

// Once, and again when the reason is another. What has no text was said elsewhere.
void FlightDirector::refused(const std::string& reason, Time now,
                             std::vector<VehicleEvent>& events) {
  const EventKind kind = goal_ == Goal::kTakeOff || goal_ == Goal::kBringBack
                             ? EventKind::kTakeOffDenied
                             : EventKind::kRequestDenied;
  const std::string short_reason = without_numbers(reason);
  if (reason.empty() || short_reason == denied_) return;
  denied_ = short_reason;
  const auto said = said_.find({kind, short_reason});
  if (said != said_.end() && now - said->second < kSaidAgain) return;
  if (said_.size() >= kMaxReasons) said_.clear();
  said_[{kind, short_reason}] = now;
  events.push_back({kind, reason});
}

// By return and by landing in turn; that neither is taken is reported once.
void FlightDirector::not_brought_back(const std::string& reason,
                                      std::vector<VehicleEvent>& events) {
  const bool both = lands_next_ || !hovers_;
  if (both && !std::exchange(not_back_said_, true))
    events.push_back({EventKind::kNotBroughtBack,
                      fmt::format("{}{}{}; only its pilot or a failsafe of its own can "
                                  "bring it back",
                                  not_back_, not_back_.empty() ? "" : "; ", reason)});
  not_back_ = reason;
  lands_next_ = hovers_ && !lands_next_;
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
    case Goal::kBringBack:
      return mode == VehicleMode::kReturn || mode == VehicleMode::kLand;
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
  events.push_back({EventKind::kHandedBack, "by a command"});
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
  const bool lands = goal_ == Goal::kLand || goal_ == Goal::kBringBack;
  if (control_.step(now, condition, lands, events)) begin_again();
  if (!pending_event_.empty()) refused(std::exchange(pending_event_, {}), now, events);
  if (control_.is_taken()) {
    reached_ = false;
    return;
  }
  const bool brings_back = goal_ == Goal::kBringBack;  // by its own estimate
  if (!knows_position && !condition.on_ground && !brings_back) return;
  switch (goal_) {
    case Goal::kNone:
      return;
    case Goal::kTakeOff:
      return step_take_off(now, condition, altitude_msl, port);
    case Goal::kFly:
      return step_flight(now, condition, port);
    case Goal::kLand:
      return step_landing(now, condition, port);
    case Goal::kBringBack:
      return step_bring_back(now, condition, port);
  }
}

// Accepted and armed, it is to leave the ground.
void FlightDirector::watch_stand(Time now, const VehicleCondition& condition) {
  const bool stands = started_ && condition.armed && condition.on_ground;
  if (!stands) return stands_since_.reset();
  if (!stands_since_) stands_since_ = now;
  if (now - *stands_since_ > kStands)
    pending_event_ = fmt::format("take-off: accepted, but it still stands, armed, in {}",
                                 condition.mode_name);
}

void FlightDirector::step_take_off(Time now, const VehicleCondition& condition,
                                   double altitude_msl, VehiclePort& port) {
  const bool flies = condition.armed && !condition.on_ground;
  // In the air already: there is nothing to take off from.
  if (flies && !asked_) done_ = true;
  if (flies && altitude_msl >= take_off_.altitude_msl - kArrival) done_ = true;
  reached_ = flies && started_;
  if (done_) return set_goal(Goal::kFly);
  watch_stand(now, condition);
  if (std::exchange(disarm_, false) && condition.armed && condition.on_ground) {
    port.send(0, ArmRequest{false, false});
    again_at_ = now + kDisarmed;
  }
  // That it is armed is told some time after it was accepted.
  if (!flies && started_ && !condition.armed && may_ask(now)) {
    started_ = false;
    pending_event_ = "take-off: accepted, but it is disarmed again";
    again_at_ = now + kAgain;
  }
  if (started_ || !may_ask(now)) return;
  armed_before_ = condition.armed;
  ask(now, take_off_, port);
}

void FlightDirector::step_flight(Time now, const VehicleCondition& condition,
                                 VehiclePort& port) {
  reached_ = condition.mode == VehicleMode::kGuided && condition.armed;
  const bool flies = condition.armed && !condition.on_ground;
  if (flies && condition.mode != VehicleMode::kGuided && may_ask(now))
    ask(now, ModeRequest{VehicleMode::kGuided}, port);
}

void FlightDirector::step_bring_back(Time now, const VehicleCondition& condition,
                                     VehiclePort& port) {
  done_ = condition.on_ground && !condition.armed;
  reached_ = is_wanted(condition.mode);
  if (!done_ && !reached_ && !condition.on_ground && may_ask(now))
    ask(now, ModeRequest{lands_next_ ? VehicleMode::kLand : VehicleMode::kReturn}, port);
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
