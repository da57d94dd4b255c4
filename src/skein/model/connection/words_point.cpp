// SPDX-License-Identifier: Apache-2.0
#include "skein/model/connection/words_point.h"

#include <algorithm>

#include "skein/base/math.h"
#include "skein/model/connection/tangent_word.h"

namespace skein::model::words {
namespace {

constexpr int kMarch = 64;  // looks at the path through each ring
constexpr int kHalvings = 60;
constexpr double kMet = 1e-9;  // spare time that is none; a jump leaves more

// Two opposite turns to a point that is d from the first one's centre, 1 <= d <= 3: the
// second centre is 2 from the first and 1 from the point, which gives two triangles.
struct TwoTurns {
  double first = 0, last = 0;
};
TwoTurns two_turns(const Vec2& offset, double side) {
  const double d2 = offset.squaredNorm(), d = std::sqrt(d2);
  const double angle = math::acos(std::clamp((d2 + 3) / (4 * d), -1.0, 1.0));
  const double towards = math::atan2(offset.y(), offset.x()) + side * angle;
  const Vec2 rest = offset - 2 * geo::unit(towards);  // from the second centre
  const double at_point = math::atan2(rest.y(), rest.x());
  return {turned(towards + kTurn / 4), turned(towards + kTurn / 2 - at_point)};
}

class TurnTurn {
 public:
  TurnTurn(const PointProblem& p, double side)
      : offset_(p.point - Vec2(0, 1)), wind_(p.wind), side_(side) {}

  // The earliest meeting in [low, high].
  Meeting first_in(double low, double high) const {
    if (!(low < high)) return {};
    double at_low = spare(low);
    if (std::abs(at_low) <= kMet) return meeting(low);
    for (int i = 1; i <= kMarch; ++i) {
      const double a = low + (high - low) * (i - 1) / kMarch;
      const double b = low + (high - low) * i / kMarch;
      const double at_b = spare(b);
      // Spare time of whole turns is flown as circles.
      for (double level = std::max(0.0, kTurn * std::ceil(at_low / kTurn)); level <= at_b;
           level += kTurn) {
        const double met = rise(level, a, b);
        if (met < kNever) return meeting(met);
      }
      at_low = at_b;
    }
    return {};
  }

 private:
  double spare(double time) const {
    const TwoTurns turns = two_turns(offset_ - wind_ * time, side_);
    return time - turns.first - turns.last;
  }
  // Where the spare time rises through a level; kNever where it jumps.
  double rise(double level, double low, double high) const {
    for (int k = 0; k < kHalvings; ++k) {
      const double middle = (low + high) / 2;
      (spare(middle) < level ? low : high) = middle;
    }
    return std::abs(spare(high) - level) < kMet ? high : kNever;
  }
  Meeting meeting(double time) const {
    const TwoTurns turns = two_turns(offset_ - wind_ * time, side_);
    const double loops = std::round((time - turns.first - turns.last) / kTurn);
    return {time, {turns.first + kTurn * loops, turns.last, 0}};
  }

  Vec2 offset_, wind_;
  double side_;
};

// Times from 0 on at which `way - wind T` comes within `radius`, and leaves.
struct Passage {
  double enter = kNever, leave = kNever;
};
Passage passage(const PointProblem& p, double radius) {
  const Vec2 offset = p.point - Vec2(0, 1);
  const double b = offset.dot(p.wind);
  const double root2 = b * b - p.wind2 * (offset.squaredNorm() - radius * radius);
  if (root2 <= 0) return {};
  const double root = std::sqrt(root2);
  const double leave = (b + root) / p.wind2;
  if (leave <= 0) return {};
  return {std::max(0.0, (b - root) / p.wind2), leave};
}

}  // namespace

PointProblem PointProblem::mirrored() const {
  return {{point.x(), -point.y()}, {wind.x(), -wind.y()}, wind2};
}

bool stays_outside(const PointProblem& p, double time) {
  const Vec2 offset = p.point - Vec2(0, 1), end = p.point - p.wind * time;
  if (p.point.y() < 0 || end.y() < 0) return false;
  const double nearest = std::clamp(offset.dot(p.wind) / p.wind2, 0.0, time);
  return (offset - p.wind * nearest).squaredNorm() >= 1;
}

Meeting turn_straight(const PointProblem& p, double best) {
  const Vec2 offset = p.point - Vec2(0, 1);
  const double min = straight_after(offset, p.wind, 1 - p.wind2, 1) * (1 - kRounding);
  return earliest_meeting({offset, p.wind, p.wind2, 1, 1, 0}, min, best);
}

Meeting turn_turn(const PointProblem& p, double best) {
  Meeting first;
  for (const double side : {1.0, -1.0}) {
    const TurnTurn word(p, side);
    const auto take = [&](const Meeting& m) {
      if (m.time < std::min(first.time, best)) first = m;
    };
    // The ring between 1 and 3 is crossed once, or twice with the disc inside between.
    const Passage outer = passage(p, 3), inner = passage(p, 1);
    const double end = std::min({outer.leave, best, first.time});
    if (outer.enter == kNever) continue;
    if (inner.enter == kNever) {
      take(word.first_in(outer.enter, end));
      continue;
    }
    take(word.first_in(outer.enter, std::min(inner.enter, end)));
    take(word.first_in(inner.leave, std::min(end, first.time)));
  }
  return first;
}

}  // namespace skein::model::words
