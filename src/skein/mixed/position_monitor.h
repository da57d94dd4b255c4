// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "skein/base/time.h"
#include "skein/data/vehicle/vehicle_report.h"
#include "skein/role/vehicle.h"

namespace skein::mixed {

/// Whether a vehicle behind a link can be commanded by its position: that is new, comes
/// from satellites or what replaces them, and moves as a vehicle can.
///
///   jump:  |p(t2) - p(t1)| > kSlack + 1.5 v_max (t2 - t1)
///
/// When satellites are back after a loss, where it is then is no jump. What it jumped is
/// remembered: it is good again once it has jumped back, or when
/// somebody says so (accept()). Each loss is one event, and so is its end: of a jump, and
/// of flight by dead reckoning, after a second without another.
class PositionMonitor {
 public:
  /// @param max_speed  over ground [m/s].
  /// @param max_age    older motions are no position.
  PositionMonitor(double max_speed, Time max_age)
      : max_speed_(max_speed), max_age_(max_age) {}

  void hear(const VehicleMotion& motion);

  /// Once a step of the run.
  /// @param link_up  else the loss of the link says it all. On the ground nothing is
  ///                 said: where it is, is checked before its take-off.
  void step(Time now, const VehicleCondition& condition, bool link_up,
            std::vector<VehicleEvent>& events);

  /// Where it says that it is counts from now on.
  void accept() { jumped_N_.setZero(); }

  bool is_good() const { return state_ == State::kGood; }
  /// It has, and not back.
  bool has_jumped() const { return state_ == State::kJumped; }
  /// Why it is not, for people; empty while it is.
  std::string_view why() const { return why_; }

 private:
  enum class State : std::uint8_t { kUnknown, kGood, kOld, kLost, kJumped };
  State state_now(Time now, const VehicleCondition& condition) const;
  void lose(State state, Time now, bool link_up, bool on_ground,
            std::vector<VehicleEvent>& events);

  double max_speed_;
  Time max_age_;
  State state_ = State::kUnknown;
  std::optional<VehicleMotion> last_;
  Vec3 jumped_N_ = Vec3::Zero();
  double jump_ = 0;    // the last one [m]
  bool said_ = false;  // that it is lost
  Time lost_at_;
  std::optional<Time> good_since_;
  std::string why_;
};

}  // namespace skein::mixed
