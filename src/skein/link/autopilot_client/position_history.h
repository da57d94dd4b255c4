// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <optional>
#include <utility>
#include <vector>

#include "skein/base/time.h"
#include "skein/data/vehicle/vehicle_report.h"
#include "skein/link/autopilot_client/preflight_check.h"

namespace skein::autopilot_client {

/// What a vehicle has reported of where it is, as far as that matters before it is
/// commanded: how often, whether it has jumped, whether it is where it is to begin.
class PositionHistory {
 public:
  /// @param start  where it is to be before it is first commanded; none: anywhere.
  explicit PositionHistory(std::optional<StartArea> start) : start_(std::move(start)) {}

  /// A position message has come in, whatever is in it.
  void count(Time now);

  /// Takes in the motion of one.
  /// @param known      the vehicle is sure of it; by dead reckoning it drifts, and jumps
  ///                   when satellites are back.
  /// @param commanded  it has been, or stands: where it is is checked elsewhere.
  /// @returns          events: a jump, a wrong place, each once.
  std::vector<OutsideEvent> add(const VehicleMotion& motion, bool known, bool commanded,
                                Time now);

  /// In flight and not commanded yet, it is where it is to begin.
  bool is_in_place() const { return !start_ || (motion_ && !misplaced_); }

  /// What the check before take-off asks of it.
  /// @param set_up  when its telemetry was last requested.
  void describe_to(PreflightInputs& in, Time set_up, Time now) const;

  /// Its link was down: what it reported before says nothing of its rate.
  void forget();
  /// It has rebooted: its next position is the first.
  void forget_motion() { motion_.reset(); }

 private:
  std::optional<StartArea> start_;
  std::optional<VehicleMotion> motion_;  // the last
  Time motion_at_;                       // when it came in
  bool known_ = false;                   // it was one that the vehicle is sure of
  bool misplaced_ = false;
  std::optional<Time> jump_at_;
  std::deque<Time> positions_;  // when they came in, those of late
};

}  // namespace skein::autopilot_client
