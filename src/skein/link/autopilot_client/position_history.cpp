// SPDX-License-Identifier: Apache-2.0
#include "skein/link/autopilot_client/position_history.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

namespace skein::autopilot_client {
namespace {

const Time kRateWindow = Time::from_seconds(5);  // of positions
// A position that is further from where the last one leads has jumped.
constexpr double kJumpDistance = 50;             // and what it flies in a second [m]
constexpr double kJumpSpeed = 20;                // and so much more for each second [m/s]
const Time kJumpWindow = Time::from_seconds(5);  // after more nobody knows

}  // namespace

void PositionHistory::count(Time now) {
  positions_.push_back(now);
  while (now - positions_.front() > kRateWindow) positions_.pop_front();
}

std::vector<OutsideEvent> PositionHistory::add(const VehicleMotion& motion, bool known,
                                               bool commanded, Time now) {
  std::vector<OutsideEvent> events;
  if (motion_ && known && known_) {
    const double dt = (motion.time - motion_->time).seconds();
    const Vec3 off = motion.p_N - motion_->p_N - dt * motion_->v_N;
    const double limit =
        kJumpDistance + motion.v_N.norm() + kJumpSpeed * std::max(dt, 0.0);
    if (motion.time - motion_->time < kJumpWindow && off.norm() > limit) {
      jump_at_ = now;
      events.push_back(
          {EventKind::kPositionJumped,
           fmt::format("its position jumped by {:.0f} m in {:.1f} s", off.norm(), dt)});
    }
  }
  known_ = known;
  motion_at_ = now;
  motion_ = motion;
  if (commanded || !start_) {
    misplaced_ = false;
    return events;
  }
  std::string why = misplaced(motion.p_N, *start_, false);
  const bool was_misplaced = std::exchange(misplaced_, !why.empty());
  if (misplaced_ && !was_misplaced)
    events.push_back({EventKind::kWrongPlace, std::move(why) + "; it is not commanded"});
  return events;
}

void PositionHistory::describe_to(PreflightInputs& in, Time set_up, Time now) const {
  in.start = start_;
  if (motion_) {
    in.position = motion_->p_N;
    in.position_age = (motion_at_ - motion_->time).seconds();
  }
  const double window = (now - std::max(set_up, now - kRateWindow)).seconds();
  in.position_rate = window > 0 ? static_cast<double>(positions_.size()) / window : 0;
  in.since_position = positions_.empty() ? 1e9 : (now - positions_.back()).seconds();
  if (jump_at_) in.since_jump = (now - *jump_at_).seconds();
}

void PositionHistory::forget() {
  motion_.reset();
  positions_.clear();
}

}  // namespace skein::autopilot_client
