// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>

#include "skein/base/time.h"
#include "skein/geo/vec.h"

namespace skein::reasoning {

/// How far an aircraft is off its plan: the 95th percentile of the last 60 s,
/// horizontally in any direction, and up and down.
///
/// Before anything was flown it is 8 m and 2 m. It grows at once and shrinks by at most
/// 10 % a minute, so that the separation of a pair never rests on a few good seconds.
class ExecutionErrors {
 public:
  /// The aircraft is so far off its plan now. At least a second after the last call.
  void add(Time now, const Vec3& off);

  double across() const { return across_; }  ///< [m]
  double height() const { return height_; }  ///< [m]

 private:
  struct Sample {
    Time time;
    double across, height;
  };
  std::deque<Sample> samples_;
  double across_ = 8, height_ = 2;
};

}  // namespace skein::reasoning
