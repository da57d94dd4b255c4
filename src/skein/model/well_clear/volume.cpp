// SPDX-License-Identifier: Apache-2.0
#include "skein/model/well_clear/volume.h"

#include <algorithm>
#include <cmath>

namespace skein::model {
namespace {

constexpr ConflictSpan kNoConflict{};

ConflictSpan vertical_span(const WellClearVolume& volume, double z, double vz,
                           double horizon) {
  const double height = volume.vertical;
  if (vz == 0)
    return std::abs(z) <= height ? ConflictSpan{0, horizon} : ConflictSpan{1, 0};
  const double ahead = std::max(height, std::abs(vz) * volume.coaltitude);
  const double sign = vz > 0 ? 1 : -1;
  const double entry = (-sign * ahead - z) / vz;
  const double exit = (sign * height - z) / vz;
  return {std::max(0.0, entry), std::min(horizon, exit)};
}

}  // namespace

ConflictSpan conflict_span(const WellClearVolume& volume, const RelativeMotion& motion,
                           double horizon) {
  const ConflictSpan vertical = vertical_span(volume, motion.z, motion.vz, horizon);
  if (!(vertical.in < vertical.out)) return kNoConflict;
  const double x = motion.x + vertical.in * motion.vx;
  const double y = motion.y + vertical.in * motion.vy;
  const double dd = volume.horizontal * volume.horizontal;
  const double ss = x * x + y * y;
  const double sv = x * motion.vx + y * motion.vy;
  const double vv = motion.vx * motion.vx + motion.vy * motion.vy;
  const bool inside = ss <= dd;
  if (inside && vv == 0) return vertical;
  if (!inside && sv >= 0) return kNoConflict;
  const double cross = x * motion.vy - y * motion.vx;
  const double delta = dd * vv - cross * cross;
  if (delta < 0) return kNoConflict;
  double in = 0;
  if (!inside) {
    const double b = 2 * sv + volume.tau * vv;
    const double c = ss + volume.tau * sv - dd;
    const double root = b * b - 4 * vv * c;
    if (root < 0) return kNoConflict;
    in = std::max(0.0, (-b - std::sqrt(root)) / (2 * vv));
  }
  const double out = (-sv + std::sqrt(delta)) / vv;
  return {vertical.in + in, std::min(vertical.in + out, vertical.out)};
}

bool is_within(const WellClearVolume& volume, const RelativeMotion& motion) {
  const double z = std::abs(motion.z);
  const bool converges = motion.z * motion.vz < 0;
  if (z > volume.vertical && !(converges && z <= volume.coaltitude * std::abs(motion.vz)))
    return false;
  const double dd = volume.horizontal * volume.horizontal;
  const double ss = motion.x * motion.x + motion.y * motion.y;
  if (ss <= dd) return true;
  const double sv = motion.x * motion.vx + motion.y * motion.vy;
  if (sv >= 0) return false;
  const double vv = motion.vx * motion.vx + motion.vy * motion.vy;
  const double cross = motion.x * motion.vy - motion.y * motion.vx;
  return cross * cross <= dd * vv && (dd - ss) / sv <= volume.tau;
}

}  // namespace skein::model
