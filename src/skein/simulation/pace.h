// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>

#include "skein/base/time.h"
#include "skein/role/operator_console.h"

namespace skein::simulation {

/// Keeps simulated time and wall time in step, and measures both. The only place where a
/// run looks at the wall clock; nothing simulated depends on it.
class Pace {
 public:
  /// @param speed  simulated seconds per wall second; 0 = never waits.
  /// @param begun  the simulated time of now.
  Pace(double speed, Time step, Time begun);

  /// Sleeps until `now` is due, or until the operator asks to stop: looked at every 50
  /// ms. Counts a miss when `now` was due more than a step ago.
  void wait_for(Time now, const OperatorConsole& console);

  /// Waits a little while the run is paused; that time does not make it late.
  void nap();

  /// From the simulated time `now` on, at another speed; 0 = never waits.
  void set_speed(double speed, Time now);

  double wall_s() const;
  std::int64_t misses() const { return misses_; }

  /// True at most every 0.2 s of wall time: when to show progress.
  bool show_due();

 private:
  using Clock = std::chrono::steady_clock;
  double late(Time now) const;

  double speed_;
  Time step_;
  double step_wall_s_;
  // Where simulated and wall time were last in step.
  double origin_wall_s_ = 0;
  Time origin_;
  Clock::time_point start_;
  Clock::time_point last_show_;
  std::int64_t misses_ = 0;
};

}  // namespace skein::simulation
