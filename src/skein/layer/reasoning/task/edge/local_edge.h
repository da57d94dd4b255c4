// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>

#include "skein/base/time.h"
#include "skein/geo/vec.h"

namespace skein::reasoning {

/// A place where the edge was crossed.
struct Mark {
  Time time;
  Vec2 point = Vec2::Zero();  ///< [m]
};

/// An edge near one point, as an arc.
struct LocalEdge {
  Vec2 point = Vec2::Zero();  ///< on the edge [m]
  double course = 0;          ///< along the edge there [rad]
  double curvature = 0;       ///< [1/m], positive turns right

  /// Direction of the edge beside `p` [rad]. The arc is believed 200 m ahead.
  double course_at(const Vec2& p) const;
  /// Distance of `p` from the edge [m], right positive.
  double right_of(const Vec2& p) const;
};

/// The arc near the newest of some crossings.
///
/// Least squares of y = a + b x + c x^2 / 2 in a frame at the newest crossing with its
/// axis along `course`. Crossings count less the further away they are; b and c have
/// priors of mean 0, so one crossing alone gives `course` back.
///
/// @param marks      at least one; newest last.
/// @param course     believed direction [rad].
/// @param course_sd  of that belief [rad].
LocalEdge fit_edge(const std::deque<Mark>& marks, double course, double course_sd);

}  // namespace skein::reasoning
