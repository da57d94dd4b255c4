// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "skein/base/check.h"
#include "skein/base/time.h"

namespace skein::sensory {

/// Says when a sensor's next sample is due: at whole multiples of its period since the
/// run's start, or at the first moment asked after that.
class SampleClock {
 public:
  /// @param rate_hz  samples per second, above 0; the period is rounded to 1 ns.
  explicit SampleClock(double rate_hz)
      : period_ns_(Time::from_seconds(1 / rate_hz).ns()) {
    SKEIN_CHECK(rate_hz > 0 && period_ns_ > 0, rate_hz);
  }

  /// Whether a sample is due at `now`; at most once per period. Times never go back.
  bool due(Time now) {
    if (now.ns() < next_ns_) return false;
    next_ns_ += period_ns_;
    if (now.ns() >= next_ns_)  // asked late: skip what was missed
      next_ns_ = (now.ns() / period_ns_ + 1) * period_ns_;
    return true;
  }

  double period() const { return static_cast<double>(period_ns_) * 1e-9; }  ///< [s]

 private:
  std::int64_t period_ns_;
  std::int64_t next_ns_ = 0;
};

}  // namespace skein::sensory
