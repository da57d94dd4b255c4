// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "skein/base/time.h"
#include "skein/data/vehicle/control.h"

namespace skein::autopilot {

struct MotorWatchOptions {
  double idle = 0.1;   ///< a motor with more throttle than this should turn, 0 to 1
  double delay = 0.3;  ///< for which it must stand to have failed [s]
};

/// Distinguishes motors that have failed from motors that were commanded to stand.
class MotorWatch {
 public:
  explicit MotorWatch(const MotorWatchOptions& options);

  /// @param standing  PowerSample::motors_standing, the last known.
  /// @param commanded what the actuators were last commanded.
  /// @returns  bit k: motor k has stood under throttle for longer than the delay.
  std::uint8_t step(Time now, std::uint8_t standing, const Actuators& commanded) {
    if (standing == 0) [[likely]] {
      suspect_ = 0;
      return 0;
    }
    return examine(now, standing, commanded);
  }

 private:
  std::uint8_t examine(Time now, std::uint8_t standing, const Actuators& commanded);

  double idle_;
  Time delay_;
  std::array<Time, Actuators::kMaxChannels> since_{};
  std::uint8_t suspect_ = 0;
};

}  // namespace skein::autopilot
