// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/avoidance/encounter/relative_motion.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace skein::reasoning {
namespace {

// Roots of a t^2 + 2 b t + c, without cancellation; none where they are not two.
std::optional<MotionSpan> roots(double a, double b, double c) {
  const double discriminant = b * b - a * c;
  if (a == 0 || !(discriminant > 0)) return std::nullopt;
  const double q = -(b + std::copysign(std::sqrt(discriminant), b));
  const double one = q / a, other = q != 0 ? c / q : -one;
  return MotionSpan{std::min(one, other), std::max(one, other)};
}

}  // namespace

std::optional<MotionSpan> time_within(const RelativeMotion& motion, double duration,
                                      const Separation& separation) {
  MotionSpan within{0, duration};
  const auto keep = [&](const MotionSpan& other) {
    within = {std::max(within.begin, other.begin), std::min(within.end, other.end)};
  };
  const Vec2 p = motion.p_N.head<2>(), v = motion.v_N.head<2>();
  const double d = separation.horizontal, out = p.squaredNorm() - d * d;
  if (v.squaredNorm() > 0) {
    const auto near = roots(v.squaredNorm(), p.dot(v), out);
    if (!near) return std::nullopt;
    keep(*near);
  } else if (out >= 0) {
    return std::nullopt;
  }
  const double z = motion.p_N.z(), w = motion.v_N.z();
  if (w != 0) {
    const double one = (-separation.vertical - z) / w;
    const double other = (separation.vertical - z) / w;
    keep({std::min(one, other), std::max(one, other)});
  } else if (std::abs(z) >= separation.vertical) {
    return std::nullopt;
  }
  if (!(within.begin < within.end)) return std::nullopt;
  return within;
}

Closest closest(const RelativeMotion& motion, const MotionSpan& span,
                const Separation& separation) {
  const Vec2 p = motion.p_N.head<2>() / separation.horizontal;
  const Vec2 v = motion.v_N.head<2>() / separation.horizontal;
  const double z = motion.p_N.z() / separation.vertical;
  const double w = motion.v_N.z() / separation.vertical;
  // Both shares are convex over time, so the larger of them is least where one of them is
  // or where they are equal.
  std::array<double, 6> times{span.begin, span.end};
  std::size_t count = 2;
  if (v.squaredNorm() > 0) times[count++] = -p.dot(v) / v.squaredNorm();
  if (w != 0) times[count++] = -z / w;
  if (const auto equal =
          roots(v.squaredNorm() - w * w, p.dot(v) - z * w, p.squaredNorm() - z * z)) {
    times[count++] = equal->begin;
    times[count++] = equal->end;
  }
  Closest best{std::max(Vec2(p + span.begin * v).norm(), std::abs(z + span.begin * w)),
               span.begin};
  for (std::size_t k = 1; k < count; ++k) {
    const double t = times[k];
    if (!(t > span.begin && t <= span.end)) continue;
    const double ratio = std::max(Vec2(p + t * v).norm(), std::abs(z + t * w));
    if (ratio < best.ratio) best = {ratio, t};
  }
  return best;
}

}  // namespace skein::reasoning
