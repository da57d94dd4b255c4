// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "skein/base/math.h"
#include "skein/model/connection/words.h"

namespace skein::model::words {
namespace {

constexpr int kMaxNewton = 100;

// f(T) = |D - w T|^2 - 8 - 8 cos((T - c) / 2), which is 0 where a middle turn fits
// between the outer ones. Written with squares, it keeps its digits where both are small.
struct Gap {
  Vec2 d0, wind;
  double c;
  double value(double t) const {
    const double cosine = math::cos((t - c) / 4);
    return (d0 - wind * t).squaredNorm() - 16 * cosine * cosine;
  }
  double slope(double t) const {
    return -2 * wind.dot(d0 - wind * t) + 4 * math::sin((t - c) / 2);
  }
};

// Newton on sign f, which is convex, from `t`, where it is positive, towards `end`: it
// never oversteps a root. kNever when there is none before `end`.
double approach(const Gap& f, double sign, double t, double end) {
  const double direction = end > t ? 1 : -1;
  for (int i = 0; i < kMaxNewton; ++i) {
    const double value = sign * f.value(t), slope = sign * f.slope(t);
    if (value <= 0) return t;
    if (slope * direction >= 0) return kNever;
    const double next = t - value / slope;
    if ((next - end) * direction > 0) return kNever;
    if (std::abs(next - t) <= 1e-15 * std::abs(t) + 1e-16) return next;
    t = next;
  }
  return t;
}

// The roots within [low, high], where sign f is convex, in order; at most two.
struct Roots {
  std::array<double, 2> at{};
  std::size_t count = 0;
};
Roots roots(const Gap& f, double sign, double low, double high) {
  Roots found;
  if (!(low <= high)) return found;
  const double at_low = sign * f.value(low), at_high = sign * f.value(high);
  const auto add = [&](double t) {
    if (t < kNever) found.at[found.count++] = t;
  };
  if (at_low > 0) add(approach(f, sign, low, high));
  if (at_low == 0) add(low);
  if (at_high > 0 && (at_low <= 0 || found.count > 0)) add(approach(f, sign, high, low));
  if (at_high == 0 && high > low) add(high);
  return found;
}

class ThreeTurns {
 public:
  ThreeTurns(const Problem& p, double low, double high)
      : p_(p), d0_(p.same_turns()), low_(low), high_(high) {}

  Meeting first() const {
    // While the centres come and go within 4 radii, each c serves the meetings of
    // [c - 2 pi, c + 2 pi], those before c with a middle turn under pi.
    Meeting best;
    const double turns = std::max(-1.0, std::ceil((low_ - kTurn - p_.phi) / kTurn));
    for (double c = p_.phi + turns * kTurn; c - kTurn <= std::min(high_, best.time);
         c += kTurn) {
      const Meeting m = first_about(c, std::min(high_, best.time));
      if (m.time < best.time) best = m;
    }
    return best;
  }

 private:
  Meeting first_about(double c, double high) const {
    const Gap f{d0_, p_.wind, c};
    // f'' = 2 w^2 + 2 cos((T - c)/2): convex in the middle, concave on both sides.
    const double bend = 2 * math::acos(-p_.wind2);
    const std::array<double, 4> cuts = {c - kTurn, c - bend, c + bend, c + kTurn};
    for (std::size_t i = 0; i < 3; ++i) {
      const double low = std::max(low_, cuts[i]), end = std::min(high, cuts[i + 1]);
      if (low > end) continue;
      const Roots r = roots(f, i == 1 ? 1 : -1, low, end);
      for (std::size_t k = 0; k < r.count; ++k) {
        const Meeting m = meeting(r.at[k], c);
        if (m.time < kNever) return m;
      }
    }
    return {};
  }

  // The turns of a root, where no outer one is negative.
  Meeting meeting(double time, double c) const {
    const Vec2 d = d0_ - p_.wind * time;
    const double half = (time - c) / 4;  // signed: sigma gamma
    const double axis = math::atan2(d.y(), d.x());
    const double first = turned(axis + half + kTurn / 4);
    const double middle = kTurn / 2 + 2 * half;
    const double last = turned(p_.phi - axis + half + kTurn / 4);
    const double loops = std::round((time - first - middle - last) / kTurn);
    if (loops < 0) return {};
    return {time, {first + kTurn * loops, middle, last}};
  }

  const Problem& p_;
  Vec2 d0_;
  double low_, high_;
};

}  // namespace

Meeting three_turns(const Problem& p, double best) {
  // The outer circles' centres must be within 4.
  const Vec2 d0 = p.same_turns();
  const double outside = d0.squaredNorm() - 16;
  const double b = d0.dot(p.wind);
  const double root2 = b * b - p.wind2 * outside;
  if (root2 < 0) return {};
  const double root = std::sqrt(root2);
  const double big = b > 0 ? b + root : b - root;
  if (big == 0) return {};
  const double t1 = big / p.wind2, t2 = outside / big;
  const double low = std::max(0.0, std::min(t1, t2));
  const double high = std::min(best, std::max(t1, t2));
  if (!(low <= high)) return {};
  return ThreeTurns(p, low, high).first();
}

}  // namespace skein::model::words
