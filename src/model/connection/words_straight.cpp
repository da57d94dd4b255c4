#include <algorithm>

#include "model/connection/words.h"

namespace skein::model::words {
namespace {

// Turning centres this near to touching may touch.
constexpr double kTouch = 1e-12;
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
      // The slope of the spare time lies in [1 - |w|, 1 + |w|].
      const double earliest = low + missing / (1 + wind);
      if (earliest >= high) return {};
      const Moment m =
          solve(start, missing, earliest, std::min(high, low + missing / (1 - wind)));
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
      double next = time + left / (1 + m.u.dot(p_.wind));
      if (std::abs(next - time) <= 1e-15 * time + 1e-16) return m;
      if (next >= high && !reached) next = high;
      if (!(next >= low && next <= high)) next = (low + high) / 2;
      if (next == time) return m;
      time = next;
    }
    return at(time);
  }

  const Problem& p_;
  double best_;
  Vec2 d0_;
};

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
    // u = |D - w (c + u)|: the straight is as long as what it is flown for.
    const Vec2 d = d0 - p.wind * c;
    const double d2 = d.squaredNorm();
    const double b = d.dot(p.wind);
    const double root = std::sqrt(b * b + a * d2);
    const double s = b > 0 ? d2 / (b + root) : (root - b) / a;
    if (c + s >= best) return {};
    if (s < kTouch) return {c + s, {c, s, 0}};
    const Vec2 along = d - p.wind * s;
    const double first = turned(std::atan2(along.y(), along.x()));
    const double last = c - first;
    if (last >= -kSnap) return {c + s, {first, s, std::max(0.0, last)}};
  }
  return {};
}

Meeting opposite_turns(const Problem& p, double best) {
  const OppositeTurns word(p, best);
  // While the centres are nearer than 2 there is no inner tangent.
  const Vec2 d0 = p.opposite_turns();
  const double outside = d0.squaredNorm() - 4 + kTouch;
  const double b = d0.dot(p.wind);
  const double root2 = b * b - p.wind2 * outside;
  if (p.wind2 == 0) return outside >= 0 ? word.first_in(0, kNever) : Meeting{};
  if (root2 <= 0) return word.first_in(0, kNever);
  const double root = std::sqrt(root2);
  // Without cancellation: the product of the two times is outside / wind2.
  const double big = b > 0 ? b + root : b - root;
  const double t1 = big / p.wind2, t2 = outside / big;
  const double enter = std::min(t1, t2), leave = std::max(t1, t2);
  if (enter >= 0) {
    const Meeting before = word.first_in(0, enter);
    if (before.time < kNever) return before;
  }
  return word.first_in(std::max(0.0, leave), kNever);
}

}  // namespace skein::model::words
