// SPDX-License-Identifier: Apache-2.0
#include "skein/model/connection/tangent_word.h"

#include <algorithm>

#include "skein/base/math.h"

namespace skein::model::words {
namespace {

constexpr double kTimeRounding = 1e-12;
constexpr int kMaxTangentSteps = 60;

// Turns and straight at one moment, and how much later than the word's shortest flight
// that moment is.
struct Moment {
  double time, s, h, first, last;
  Vec2 u;
  double spare() const { return time - first - s - last; }
};

class TangentSearch {
 public:
  TangentSearch(const TangentWord& word, double best) : word_(word), best_(best) {}

  // The earliest meeting in [low, high].
  Meeting first_in(double low, double high) const {
    high = std::min(high, best_);
    if (!(low <= high)) return {};
    const Moment start = at(low);
    // Spare time grows steadily, at 1 + u.w, but where an outer turn passes a full one it
    // jumps by a whole turn: up when the heading of the straight grows, else down.
    const double growing = -geo::cross(start.u, word_.wind);
    const double min = start.spare();
    // Its heading turns by less than a half: each turn passes a full one at most once.
    const double jumps = growing > 0 ? word_.turns : 0;
    const double wind = std::sqrt(word_.wind2);
    const double from = std::max(std::ceil((min - kSnap) / kTurn), -jumps);
    for (int k = 0; k <= word_.turns; ++k) {
      const double missing = std::max(0.0, kTurn * (from + k) - min);
      // The slope of the spare time lies in [1 - |w|, 1 + |w|]; on the bounds, straight
      // up or down the wind, rounding decides.
      const double slack = kRounding * missing + kTimeRounding * (1 + low);
      const double earliest = low + (missing - slack) / (1 + wind);
      if (earliest >= high) return {};
      // Of a wind as strong as the airspeed but for 1e-9 only that difference is known to
      // 1e-7.
      const double latest =
          low + (missing + slack) / (1 - wind) * (1 + 1e-15 / (1 - wind));
      const Moment m = solve(start, missing, earliest, std::min(high, latest));
      if (m.time >= high) return {};
      const double loops = std::round(m.spare() / kTurn);
      if (loops >= 0) return {m.time, {m.first + kTurn * loops, m.s, m.last}};
    }
    return {};
  }

 private:
  Moment at(double time) const {
    const Vec2 d = word_.offset - word_.wind * time;
    const double d2 = d.squaredNorm(), r = word_.reach;
    const double s = std::sqrt(std::max(0.0, d2 - r * r));
    const Vec2 u = Vec2(s * d.x() - r * d.y(), s * d.y() + r * d.x()) / d2;
    const double h = math::atan2(u.y(), u.x());
    return {time, s, h, turned(h), word_.turns == 2 ? turned(h - word_.phi) : 0, u};
  }

  // The moment in [low, high] at which the spare time, without its jumps, has grown by
  // `growth` since `start`; with time kNever where it comes later.
  Moment solve(const Moment& start, double growth, double low, double high) const {
    const auto missing = [&](const Moment& m) {
      return growth - (m.time - start.time) + (m.s - start.s) +
             word_.turns * geo::wrap_pi(m.h - start.h);
    };
    bool reached = false;  // within [low, high] there is a root
    double time = start.time + growth / (1 + start.u.dot(word_.wind));
    if (!(time >= low && time < high)) time = high;
    for (int i = 0; i < kMaxTangentSteps; ++i) {
      Moment m = at(time);
      const double left = missing(m);
      if (left > 0 && time >= high && !reached) {
        m.time = kNever;
        return m;
      }
      if (left <= 0) reached = true;
      (left > 0 ? low : high) = time;
      // Halley's step: the slope falls by (u x w)^2 / s per second.
      const double slope = 1 + m.u.dot(word_.wind);
      const double across = geo::cross(m.u, word_.wind);
      const double bend = m.s > 0 ? across * across / m.s : 0;
      const double newton = left / slope;
      const double step = newton / std::max(0.5, 1 - newton * bend / (2 * slope));
      double next = time + step;
      if (next >= high && !reached) next = high;
      if (!(next >= low && next <= high)) next = (low + high) / 2;
      if (next == time) return m;
      // What a step leaves is a few (bend / slope)^2 step^3; when that is rounding, the
      // next moment is the one.
      const double turn = bend * std::abs(step) / slope;
      if (turn * turn * std::abs(step) < 1e-16 * time) return at(next);
      time = next;
    }
    return at(time);
  }

  const TangentWord& word_;
  double best_;
};

}  // namespace

Meeting earliest_meeting(const TangentWord& word, double min, double best) {
  if (min >= best) return {};
  const TangentSearch search(word, best);
  // While the centre is within reach there is no tangent.
  const double outside = word.offset.squaredNorm() - word.reach * word.reach + kTouch;
  const double b = word.offset.dot(word.wind);
  const double root2 = b * b - word.wind2 * outside;
  if (root2 <= 0) return search.first_in(min, kNever);
  const double root = std::sqrt(root2);
  // Without cancellation: the product of the two times is outside / wind2.
  const double big = b > 0 ? b + root : b - root;
  const double t1 = big / word.wind2, t2 = outside / big;
  const double enter = std::min(t1, t2), leave = std::max(t1, t2);
  const Meeting before = search.first_in(min, enter);
  if (before.time < kNever) return before;
  return search.first_in(std::max(min, leave), kNever);
}

double straight_after(const Vec2& d, const Vec2& wind, double a, double gap) {
  const double d2 = d.squaredNorm() - gap;
  if (d2 <= 0) return 0;
  const double b = d.dot(wind);
  const double root = std::sqrt(b * b + a * d2);
  return b > 0 ? d2 / (b + root) : (root - b) / a;
}

}  // namespace skein::model::words
