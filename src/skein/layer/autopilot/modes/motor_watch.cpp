// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/autopilot/modes/motor_watch.h"

#include "skein/base/check.h"

namespace skein::autopilot {

MotorWatch::MotorWatch(const MotorWatchOptions& options)
    : idle_(options.idle), delay_(Time::from_seconds(options.delay)) {
  SKEIN_CHECK(options.idle >= 0 && options.idle < 1, options.idle);
  SKEIN_CHECK(options.delay >= 0 && options.delay < 1e6, options.delay);
}

std::uint8_t MotorWatch::examine(Time now, std::uint8_t standing,
                                 const Actuators& commanded) {
  unsigned failed = 0;
  unsigned suspect = 0;
  for (std::size_t k = 0; k < Actuators::kMaxChannels; ++k) {
    if ((standing >> k & 1u) == 0 || commanded[k] <= idle_) continue;
    suspect |= 1u << k;
    if ((suspect_ >> k & 1u) == 0) since_[k] = now;
    if (now - since_[k] > delay_) failed |= 1u << k;
  }
  suspect_ = static_cast<std::uint8_t>(suspect);
  return static_cast<std::uint8_t>(failed);
}

}  // namespace skein::autopilot
