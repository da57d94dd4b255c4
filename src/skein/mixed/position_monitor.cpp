// SPDX-License-Identifier: Apache-2.0
#include "skein/mixed/position_monitor.h"

#include <fmt/format.h>

#include <algorithm>

namespace skein::mixed {
namespace {

// What an estimator may be corrected by at once, a fix may be off by [m].
constexpr double kSlack = 30;
constexpr double kSpeedMargin = 1.5;
const Time kSettles = Time::from_seconds(1);

}  // namespace

void PositionMonitor::hear(const VehicleMotion& motion) {
  // By dead reckoning it drifts, and is corrected when it has satellites again.
  if (last_ && motion.time > last_->time && state_ != State::kLost) {
    const double dt = (motion.time - last_->time).seconds();
    const Vec3 moved = motion.p_N - last_->p_N;
    if (moved.norm() > kSlack + kSpeedMargin * max_speed_ * dt) {
      jumped_N_ += moved - dt * last_->v_N;
      jump_ = moved.norm();
    }
  }
  last_ = motion;
}

PositionMonitor::State PositionMonitor::state_now(
    Time now, const VehicleCondition& condition) const {
  if (!last_) return State::kUnknown;
  if (now - last_->time > max_age_) return State::kOld;
  if (!condition.position) return State::kLost;
  return jumped_N_.norm() > kSlack ? State::kJumped : State::kGood;
}

void PositionMonitor::lose(State state, Time now, bool link_up, bool on_ground,
                           std::vector<VehicleEvent>& events) {
  if (is_good()) lost_at_ = now;
  state_ = state;
  EventKind kind = EventKind::kPositionOld;
  if (state == State::kLost) {
    kind = EventKind::kPositionLost;
    why_ = "it has no position by satellites any more and flies by dead reckoning";
  } else if (state == State::kJumped) {
    kind = EventKind::kPositionJumped;
    why_ = fmt::format("its position jumped by {:.0f} m", jump_);
  } else {
    why_ =
        fmt::format("its last position is {:.1f} s old", (now - last_->time).seconds());
  }
  // On the ground it is an item of the check before take-off.
  if ((state == State::kOld && !link_up) || on_ground) return;
  said_ = true;
  events.push_back({kind, why_ + "; it is not commanded by position until it is good"});
}

void PositionMonitor::step(Time now, const VehicleCondition& condition, bool link_up,
                           std::vector<VehicleEvent>& events) {
  if (condition.on_ground) jumped_N_.setZero();
  const State state = state_now(now, condition);
  if (state != State::kGood) good_since_.reset();
  if (state == State::kUnknown || (state == State::kGood && is_good())) return;
  if (state != State::kGood) {
    if (state != state_) lose(state, now, link_up, condition.on_ground, events);
    return;
  }
  // What was wrong may be wrong again.
  const bool settles = state_ == State::kLost || state_ == State::kJumped;
  if (!good_since_) good_since_ = now;
  if (settles && now - *good_since_ < kSettles) return;
  if (said_)
    events.push_back({EventKind::kPositionBack,
                      fmt::format("its position is good again after {:.1f} s",
                                  (now - lost_at_).seconds())});
  said_ = false;
  state_ = State::kGood;
  why_.clear();
}

}  // namespace skein::mixed
