// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <chrono>

namespace skein::hmi {

/// How many messages somebody may send: so many a second in the long run, and as many at
/// once.
class MessageRate {
 public:
  using Moment = std::chrono::steady_clock::time_point;

  explicit MessageRate(double per_second) : per_second_(per_second), left_(per_second) {}

  /// Whether one more is allowed at `now`; it counts then.
  bool allows(Moment now) {
    const double passed = std::chrono::duration<double>(now - last_).count();
    left_ = std::min(per_second_, left_ + std::max(passed, 0.0) * per_second_);
    last_ = now;
    if (left_ < 1) return false;
    left_ -= 1;
    return true;
  }

 private:
  double per_second_;
  double left_;
  Moment last_{};
};

}  // namespace skein::hmi
