// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "skein/base/time.h"
#include "skein/layer/autopilot/modes/home_energy.h"

namespace skein::autopilot {

struct ConsumptionOptions {
  double lag = 20;  ///< in which the present rate follows [s], above 0
  /// Power when climbing and sinking as a part of that in level flight.
  double climb_factor = 1.8;
  double sink_factor = 0.4;
};

/// How fast the charge goes, learnt from the battery monitor in flight.
class Consumption {
 public:
  explicit Consumption(const ConsumptionOptions& options) : options_(options) {}

  /// @param charge  left, from 0 to 1, measured at `time`; times do not go back.
  void sense(Time time, double charge);

  /// Charge used per time [1/s], a full charge being 1:
  ///
  ///   r += (dt / min(lag, time since the first sample)) (-d charge / dt - r)
  ///
  /// the mean until `lag` has passed, then smoothed with it. 0 until known.
  double rate() const { return rate_; }

  /// Time until the charge is used up at the present rate [s]; none while it is not known
  /// or nothing is used.
  std::optional<double> endurance() const;

  /// Puts powers into `flight` so that home_need() counts in charge. Level flight is
  /// taken to use the present rate or the mean since the first sample, whichever is more:
  /// after a glide the path home still needs the motor.
  void set_powers(HomeFlight& flight) const;

 private:
  ConsumptionOptions options_;
  bool begun_ = false;
  Time first_, last_;
  double charge_first_ = 1;
  double charge_ = 1;
  double rate_ = 0;
};

}  // namespace skein::autopilot
