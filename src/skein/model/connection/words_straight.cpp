// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "skein/base/math.h"
#include "skein/model/connection/tangent_word.h"
#include "skein/model/connection/words.h"

namespace skein::model::words {
namespace {

constexpr double kSameCircle = 1e-12;  // centres this near have no direction

// Whether a turn from heading 0 to phi < 2 pi passes the direction of `along`, of length
// s. Asked without an angle function.
bool passed(const Problem& p, const Vec2& along, double s) {
  const double slack = -kSnap * s;
  const bool after_start = along.y() >= slack;
  const bool before_end = along.x() * p.sin_phi - along.y() * p.cos_phi >= slack;
  if (p.phi > kTurn / 2) return after_start || before_end;
  const double ahead = along.x() * (1 + p.cos_phi) + along.y() * p.sin_phi;
  return after_start && before_end && ahead >= slack;
}

}  // namespace

Problem Problem::mirrored() const {
  Problem m = *this;
  m.goal.y() = -goal.y();
  m.wind.y() = -wind.y();
  m.phi = phi == 0 ? 0 : kTurn - phi;
  m.sin_phi = -sin_phi;
  return m;
}

Meeting equal_turns(const Problem& p, double best) {
  const Vec2 d0 = p.same_turns();
  const double a = 1 - p.wind2;
  for (double c = p.phi; c < best && c < 2 * kTurn; c += kTurn) {
    const double s = straight_after(d0 - p.wind * c, p.wind, a, 0);
    if (c + s >= best) return {};
    if (s < kSameCircle) return {c + s, {c, s, 0}};
    const Vec2 along = d0 - p.wind * (c + s);
    // The second time both turns fit whatever the direction of the straight.
    if (c < kTurn && !passed(p, along, s)) continue;
    const double first = std::min(turned(math::atan2(along.y(), along.x())), c);
    return {c + s, {first, s, c - first}};
  }
  return {};
}

Meeting opposite_turns(const Problem& p, double best) {
  const Vec2 d0 = p.opposite_turns();
  // One turn undoes the other but for phi, so nothing is met before they have.
  const double c = std::min(p.phi, kTurn - p.phi);
  const double min =
      c + straight_after(d0 - p.wind * c, p.wind, 1 - p.wind2, 4) * (1 - kRounding);
  return earliest_meeting({d0, p.wind, p.wind2, 2, 2, p.phi}, min, best);
}

}  // namespace skein::model::words
