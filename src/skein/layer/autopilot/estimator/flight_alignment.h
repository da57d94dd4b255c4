// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "skein/base/time.h"
#include "skein/geo/rotation.h"
#include "skein/geo/vec.h"

namespace skein::autopilot {

/// Finds the attitude in flight from what accelerometers and satellites say of the same
/// seconds, without any attitude to begin with.
///
/// With C(t) the rotation of the body since the beginning, by the gyros:
///
///   R_NB(0) int C f dt = v(T) - v(0) - g T
///
/// Both sides are measured. They and one more vector that is known in both frames, the
/// Earth's field for one, give the attitude by the triad method.
/// Reference: [Shuster81] for the triad.
class FlightAlignment {
 public:
  /// @param v_N  velocity by satellites at the beginning [m/s].
  FlightAlignment(Time begin, const Vec3& v_N) : begin_(begin), v_N_(v_N) {}

  /// What the inertial unit has measured over `dt` [s].
  void add(const Vec3& w_B, const Vec3& f_B, double dt);

  Time begin() const { return begin_; }

  /// The attitude q_NB at the end of what has been added.
  ///
  /// @param now  that end.
  /// @param v_N  velocity by satellites then [m/s].
  /// @param u_B  the other vector in B now; only its direction counts.
  /// @param u_N  the same in N.
  /// @returns    none when the vectors are nearly parallel.
  std::optional<Quat> attitude(Time now, const Vec3& v_N, const Vec3& u_B,
                               const Vec3& u_N) const;

 private:
  Time begin_;
  Vec3 v_N_;
  Quat turned_ = Quat::Identity();  // C
  Vec3 gained_ = Vec3::Zero();      // int C f dt [m/s]
};

}  // namespace skein::autopilot
