#include <algorithm>

#include "model/connection/words.h"

namespace skein::model::words {
namespace {

// Turning centres this near to touching may touch.
constexpr double kTouch = 1e-12;
constexpr double kRounding = 1e-9;
constexpr int kMostNewton = 60;
// The heading of the straight turns by less than a half, so each outer turn passes a full
// one at most once.
constexpr int kMostJumps = 2;

// The inner tangent from a positive to a negative turn whose centres are D apart:
//
//   D = s u + 2 (sin h, -cos h),   u = (cos h, sin h)
struct Tangent {
  double s = 0;
  Vec2 u = Vec2::Zero();
};

Tangent inner_tangent(const Vec2& d) {
  const double d2 = d.squaredNorm();
  const double s = std::sqrt(std::max(0.0, d2 - 4));
  return {s, Vec2(s * d.x() - 2 * d.y(), s * d.y() + 2 * d.x()) / d2};
}

// Outer turns and straight at one moment, and how much later than the word's shortest
// flight that moment is; see docs/planning.md.
struct Moment {
  double time, s, h, first, last;
  Vec2 u;
  double spare() const { return time - first - s - last; }
};

class OppositeTurns {
 public:
  OppositeTurns(const Problem& p, double best)
      : p_(p), best_(best), d0_(p.opposite_turns()) {}

  // The earliest meeting in [low, high].
  Meeting first_in(double low, double high) const {
    high = std::min(high, best_);
    if (!(low <= high)) return {};
    const Moment start = at(low);
    // Spare time grows steadily, at 1 + u.w, but where an outer turn passes a full one it
    // jumps by a whole turn: up when the heading of the straight grows, else down.
    const double growing = -geo::cross(start.u, p_.wind);
    const double least = start.spare();
    const double jumps = growing > 0 ? kMostJumps : 0;
    const double wind = std::sqrt(p_.wind2);
    const double from = std::max(std::ceil((least - kSnap) / kTurn), -jumps);
    for (int k = 0; k <= kMostJumps; ++k) {
      const double missing = std::max(0.0, kTurn * (from + k) - least);
      // The slope of the spare time lies in [1 - |w|, 1 + |w|]; on the bounds, straight
      // up or down the wind, rounding decides.
      const double earliest = low + missing / (1 + wind) * (1 - kRounding);
      if (earliest >= high) return {};
      const double latest = low + missing / (1 - wind) * (1 + kRounding);
      const Moment m = solve(start, missing, earliest, std::min(high, latest));
      if (m.time >= high) return {};
      const double loops = std::round(m.spare() / kTurn);
      if (loops >= 0) return {m.time, {m.first + kTurn * loops, m.s, m.last}};
    }
    return {};
  }

 private:
  Moment at(double time) const {
    const Tangent t = inner_tangent(d0_ - p_.wind * time);
    const double h = std::atan2(t.u.y(), t.u.x());
    return {time, t.s, h, turned(h), turned(h - p_.phi), t.u};
  }

  // The moment in [low, high] at which the spare time, without its jumps, has grown by
  // `growth` since `start`; with time kNever where it comes later.
  Moment solve(const Moment& start, double growth, double low, double high) const {
    const auto missing = [&](const Moment& m) {
      return growth - (m.time - start.time) + (m.s - start.s) +
             2 * geo::wrap_pi(m.h - start.h);
    };
    bool reached = false;  // within [low, high] there is a root
    double time = start.time + growth / (1 + start.u.dot(p_.wind));
    if (!(time >= low && time < high)) time = high;
    for (int i = 0; i < kMostNewton; ++i) {
      Moment m = at(time);
      const double left = missing(m);
      if (left > 0 && time >= high && !reached) {
        m.time = kNever;
        return m;
      }
      if (left <= 0) reached = true;
      (left > 0 ? low : high) = time;
      // Halley's step: the slope falls by (u x w)^2 / s per second.
      const double slope = 1 + m.u.dot(p_.wind);
      const double across = geo::cross(m.u, p_.wind);
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

  const Problem& p_;
  double best_;
  Vec2 d0_;
};

// The straight flown after turns: the s >= 0 with s^2 = |d - w s|^2 - gap, where a is
// 1 - w^2.
double straight_after(const Vec2& d, const Vec2& wind, double a, double gap) {
  const double d2 = d.squaredNorm() - gap;
  if (d2 <= 0) return 0;
  const double b = d.dot(wind);
  const double root = std::sqrt(b * b + a * d2);
  return b > 0 ? d2 / (b + root) : (root - b) / a;
}

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
    if (s < kTouch) return {c + s, {c, s, 0}};
    const Vec2 along = d0 - p.wind * (c + s);
    // The second time both turns fit whatever the direction of the straight.
    if (c < kTurn && !passed(p, along, s)) continue;
    const double first = std::min(turned(std::atan2(along.y(), along.x())), c);
    return {c + s, {first, s, c - first}};
  }
  return {};
}

Meeting opposite_turns(const Problem& p, double best) {
  const Vec2 d0 = p.opposite_turns();
  // One turn undoes the other but for phi, so nothing is met before they have.
  const double c = std::min(p.phi, kTurn - p.phi);
  const double least =
      c + straight_after(d0 - p.wind * c, p.wind, 1 - p.wind2, 4) * (1 - kRounding);
  if (least >= best) return {};

  const OppositeTurns word(p, best);
  // While the centres are nearer than 2 there is no inner tangent.
  const double outside = d0.squaredNorm() - 4 + kTouch;
  const double b = d0.dot(p.wind);
  const double root2 = b * b - p.wind2 * outside;
  if (root2 <= 0) return word.first_in(least, kNever);
  const double root = std::sqrt(root2);
  // Without cancellation: the product of the two times is outside / wind2.
  const double big = b > 0 ? b + root : b - root;
  const double t1 = big / p.wind2, t2 = outside / big;
  const double enter = std::min(t1, t2), leave = std::max(t1, t2);
  const Meeting before = word.first_in(least, enter);
  if (before.time < kNever) return before;
  return word.first_in(std::max(least, leave), kNever);
}

}  // namespace skein::model::words
