// SPDX-License-Identifier: Apache-2.0
#include "skein/model/path/plan_curve.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "skein/base/check.h"

namespace skein::model {
namespace {

constexpr double kLongestStep = 0.5;  // of follow() [s]
constexpr int kChords = 8;            // of a segment, for its length
constexpr double kStill = 1e-3;       // below this there is no course [m/s]

}  // namespace

void PlanCurve::assign(const Plan& plan) {
  segments_.clear();
  current_ = 0;
  if (plan.empty()) return;
  segments_.reserve(plan.size());
  start_ = plan.front().time.seconds();
  end_ = plan.back().time.seconds();
  for (std::size_t i = 0; i + 1 < plan.size(); ++i) {
    const PlanPoint &a = plan[i], &b = plan[i + 1];
    const double h = (b.time - a.time).seconds();
    SKEIN_CHECK(h > 0, i);
    const Vec3 mean = (b.p_N - a.p_N) / h;
    segments_.push_back({a.time.seconds(), h, a.p_N, a.v_N,
                         (3 * mean - 2 * a.v_N - b.v_N) / h,
                         (a.v_N + b.v_N - 2 * mean) / (h * h), 0, 0});
  }
  if (plan.size() == 1)
    segments_.push_back(
        {start_, 0, plan[0].p_N, plan[0].v_N, Vec3::Zero(), Vec3::Zero(), 0, 0});

  double after = 0;
  for (auto g = segments_.rbegin(); g != segments_.rend(); ++g) {
    Vec2 last = g->c0.head<2>();
    for (int i = 1; i <= kChords; ++i) {
      const double s = g->span * i / kChords;
      const Vec3 p = g->c0 + s * (g->c1 + s * (g->c2 + s * g->c3));
      g->length += (p.head<2>() - last).norm();
      last = p.head<2>();
    }
    g->after = after;
    after += g->length;
  }
}

std::size_t PlanCurve::index_at(double time) const {
  std::size_t i = current_;
  while (i > 0 && time < segments_[i].begin) --i;
  while (i + 1 < segments_.size() && time >= segments_[i + 1].begin) ++i;
  current_ = i;
  return i;
}

PlanCurve::State PlanCurve::at(double time) const {
  SKEIN_CHECK(!segments_.empty());
  const Segment& g = segments_[index_at(time)];
  const double s = std::clamp(time - g.begin, 0.0, g.span);
  State state{g.c0 + s * (g.c1 + s * (g.c2 + s * g.c3)),
              g.c1 + s * (2 * g.c2 + 3 * s * g.c3), 2 * g.c2 + 6 * s * g.c3};
  const double beyond = time < start_ ? time - start_ : time - end_;
  if (time < start_ || time > end_) {
    state.p_N += beyond * state.v_N;
    state.a_N = Vec3::Zero();
  }
  return state;
}

TrackPoint PlanCurve::track(const State& state) {
  const Vec2 v = state.v_N.head<2>();
  const double speed = v.norm();
  if (speed < kStill) return {state.p_N.head<2>(), Vec2(1, 0), 0};
  return {state.p_N.head<2>(), v / speed,
          geo::cross(v, state.a_N.head<2>()) / (speed * speed * speed)};
}

double PlanCurve::follow(const Vec2& p, double time) const {
  const State here = at(time);
  const Vec2 v = here.v_N.head<2>();
  const double v2 = v.squaredNorm();
  if (v2 < kStill * kStill) return time;
  const Vec2 off = p - here.p_N.head<2>();
  // Within half the radius of curvature this is Newton's step; further inside the turn
  // its denominator would vanish.
  const double slope = std::max(v2 - off.dot(here.a_N.head<2>()), v2 / 2);
  return time + std::clamp(off.dot(v) / slope, -kLongestStep, kLongestStep);
}

double PlanCurve::nearest(const Vec2& p, double from, double to, double step) const {
  double best = from, min = std::numeric_limits<double>::infinity();
  for (double t = from;; t = std::min(t + step, to)) {
    const double distance2 = (p - at(t).p_N.head<2>()).squaredNorm();
    if (distance2 < min) {
      min = distance2;
      best = t;
    }
    if (t >= to) break;
  }
  for (int i = 0; i < 8; ++i) best = follow(p, best);
  return best;
}

double PlanCurve::remaining(double time) const {
  const Segment& g = segments_[index_at(time)];
  const double left = std::clamp(g.begin + g.span - time, 0.0, g.span);
  return g.after + (g.span > 0 ? g.length * left / g.span : 0);
}

}  // namespace skein::model
