// SPDX-License-Identifier: Apache-2.0
#include "skein/model/well_clear/manoeuvre.h"

#include <algorithm>
#include <cmath>

namespace skein::model {

LevelChange::LevelChange(const OwnMotion& own,
                         const WellClearConfiguration::Altitude& limits, double altitude)
    : vx_(own.vx), vy_(own.vy), v0_(own.vz), height_(altitude - own.z) {
  const double a = limits.accel;
  // What is flown until level when levelling off at once: beyond it, or back.
  const double at_once = v0_ * std::abs(v0_) / (2 * a);
  const double up = height_ >= at_once ? 1 : -1;
  const double rate = std::max(limits.rate, up * v0_);
  const double first = (rate * rate - v0_ * v0_) / (2 * a);  // along `up`
  const double last = rate * rate / (2 * a);
  const double steady = (up * height_ - first - last) / rate;
  // Without a steady part: the highest rate from which it levels off there.
  const double peak =
      steady >= 0 ? rate : std::sqrt(std::max(0.0, a * up * height_ + v0_ * v0_ / 2));
  rate_ = up * peak;
  a1_ = rate_ >= v0_ ? a : -a;
  a3_ = -up * a;
  t1_ = (rate_ - v0_) / a1_;
  t2_ = t1_ + std::max(0.0, steady);
  t3_ = t2_ + peak / a;
  z1_ = (v0_ + rate_) / 2 * t1_;
  z2_ = z1_ + rate_ * (t2_ - t1_);
}

ManoeuvrePoint LevelChange::at(double t) const {
  ManoeuvrePoint p{t, vx_ * t, vy_ * t, height_, vx_, vy_, 0};
  if (t < t1_) {
    p.vz = v0_ + a1_ * t;
    p.z = (v0_ + p.vz) / 2 * t;
  } else if (t < t2_) {
    p.vz = rate_;
    p.z = z1_ + rate_ * (t - t1_);
  } else if (t < t3_) {
    p.vz = rate_ + a3_ * (t - t2_);
    p.z = z2_ + (rate_ + p.vz) / 2 * (t - t2_);
  }
  return p;
}

}  // namespace skein::model
