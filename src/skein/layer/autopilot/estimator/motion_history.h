// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "skein/base/time.h"
#include "skein/geo/vec.h"

namespace skein::autopilot {

/// Where the vehicle was a moment ago, for measurements that come late. In between,
/// motion is taken to be straight, which at 10 m/s^2 costs 3 mm.
class MotionHistory {
 public:
  struct Motion {
    Vec3 p_N = Vec3::Zero();  ///< [m]
    Vec3 v_N = Vec3::Zero();  ///< [m/s]
  };

  /// Remembers the motion at `now`, unless the last one is younger than the spacing.
  void remember(Time now, const Motion& motion) {
    if (size_ > 0 && now - entry(0).time < kSpacing) return;
    newest_ = (newest_ + 1) % kMax;
    entries_[newest_] = {now, motion};
    if (size_ < kMax) ++size_;
  }

  /// The state at `now`, which was `before`, was corrected by this: so was the past, by
  /// what led to the present (see observe_position).
  ///
  ///   dv(t) = dv - u,  dp(t) = dp - (dv - u / 2) d,  u = dtheta x s - R db_accel d
  ///
  /// with d = now - t and s the velocity that the specific force has given in d.
  /// @param da  R db_accel: correction of the accelerometers' bias, in N [m/s^2].
  void correct(Time now, const Vec3& v_before, const Vec3& dp, const Vec3& dv,
               const Vec3& dtheta, const Vec3& da);

  /// The motion at `t`, which is not after `now`; none when that is too long ago.
  std::optional<Motion> at(Time t, Time now, const Motion& present) const;

  void clear() { size_ = 0; }

 private:
  static constexpr std::size_t kMax = 9;
  static constexpr Time kSpacing = Time::from_ns(49'000'000);

  struct Entry {
    Time time;
    Motion motion;
  };

  // `age` entries before the newest.
  const Entry& entry(std::size_t age) const {
    return entries_[(newest_ + kMax - age) % kMax];
  }

  std::array<Entry, kMax> entries_{};
  std::size_t newest_ = 0;
  std::size_t size_ = 0;
};

}  // namespace skein::autopilot
