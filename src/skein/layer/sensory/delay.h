// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "skein/base/check.h"
#include "skein/base/time.h"
#include "skein/data/vehicle/sensing.h"

namespace skein::sensory {

/// Holds samples back until their latency has passed: a sample measured at t comes out at
/// the first moment asked at or after t + latency. Room is taken when it is made; more of
/// it only when more samples come than were said.
template <class Sample>
class Delay {
 public:
  /// @param latency  [s], not negative; 0 lets samples through at once.
  /// @param period   time between two measurements [s].
  /// @param samples  that a measurement gives.
  Delay(double latency, double period, std::size_t samples = 1)
      : latency_(Time::from_seconds(latency)) {
    SKEIN_CHECK(latency >= 0 && period > 0, latency, period);
    if (latency > 0)
      ring_.resize((static_cast<std::size_t>(std::ceil(latency / period)) + 3) * samples);
  }

  /// Takes in what was measured at `sample.time`; it goes to `out` when its time comes.
  void put(const Sample& sample, std::vector<SensorSample>& out) {
    if (ring_.empty()) {
      out.emplace_back(sample);
      return;
    }
    if (count_ == ring_.size()) grow();
    std::size_t at = first_ + count_;
    if (at >= ring_.size()) at -= ring_.size();
    ring_[at] = sample;
    ++count_;
  }

  /// Appends what is due at `now`. Call after put(), at every moment.
  void release(Time now, std::vector<SensorSample>& out) {
    while (count_ > 0 && ring_[first_].time + latency_ <= now) {
      out.emplace_back(ring_[first_]);
      if (++first_ == ring_.size()) first_ = 0;
      --count_;
    }
  }

 private:
  void grow() {
    std::rotate(ring_.begin(), ring_.begin() + static_cast<std::ptrdiff_t>(first_),
                ring_.end());
    first_ = 0;
    ring_.resize(2 * ring_.size());
  }

  std::size_t count_ = 0;  // first: most calls look at nothing else
  std::size_t first_ = 0;
  Time latency_;
  std::vector<Sample> ring_;  // empty when there is no latency
};

}  // namespace skein::sensory
