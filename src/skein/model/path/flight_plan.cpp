// SPDX-License-Identifier: Apache-2.0
#include "skein/model/path/flight_plan.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "skein/base/check.h"
#include "skein/base/math.h"

namespace skein::model {
namespace {

constexpr double kCorner = 0.3;      // change of velocity between two elements [m/s]
constexpr double kCornerTime = 0.1;  // that it is flown in [s]
// Between points: what is rounded would be another speed between nearer ones. The later
// of two is taken, as the curve goes on with its velocity [s].
constexpr double kMinBetween = 0.05;

// Below this turned angle the chord's sine is its series: 1 - x^2/6, exact to rounding.
constexpr double kSmallAngle = 1e-4;

// Gauss's five points and weights on [-1, 1].
constexpr std::array kGaussPoints = {-0.9061798459386640, -0.5384693101056831, 0.0,
                                     0.5384693101056831, 0.9061798459386640};
constexpr std::array kGaussWeights = {0.2369268850561891, 0.4786286704993665,
                                      0.5688888888888889, 0.4786286704993665,
                                      0.2369268850561891};

Vec2 ground_velocity(const FlightElement& e, double t) {
  return e.airspeed * geo::unit(e.heading + e.turn_rate * t) + e.wind;
}

const FlightElement& element_at(const FlightPlan& plan, double time) {
  SKEIN_CHECK(!plan.empty());
  const auto after =
      std::upper_bound(plan.begin(), plan.end(), time,
                       [](double t, const FlightElement& e) { return t < e.start; });
  return after == plan.begin() ? plan.front() : *(after - 1);
}

}  // namespace

Vec3 position(const FlightElement& e, double t) {
  // The chord of a turn by 2a is V t sin(a)/a, in the direction of its middle.
  const double half = e.turn_rate * t / 2;
  const double shrink =
      std::abs(half) < kSmallAngle ? 1 - half * half / 6 : math::sin(half) / half;
  const Vec2 air = e.airspeed * t * shrink * geo::unit(e.heading + half);
  Vec3 p = e.p_N;
  p.head<2>() += air + e.wind * t;
  p.z() -= (e.climb_rate + e.climb_acceleration * t / 2) * t;
  return p;
}

FlightMoment moment(const FlightElement& e, double t) {
  FlightMoment m;
  m.p_N = position(e, t);
  m.heading = e.heading + e.turn_rate * t;
  const Vec2 v = ground_velocity(e, t);
  m.v_N = {v.x(), v.y(), -(e.climb_rate + e.climb_acceleration * t)};
  return m;
}

FlightMoment end_of(const FlightElement& element) {
  return moment(element, element.duration);
}

FlightMoment moment_at(const FlightPlan& plan, double time) {
  const FlightElement& e = element_at(plan, time);
  return moment(e, time - e.start);
}

double start_of(const FlightPlan& plan) {
  SKEIN_CHECK(!plan.empty());
  return plan.front().start;
}

double end_time_of(const FlightPlan& plan) {
  SKEIN_CHECK(!plan.empty());
  return plan.back().start + plan.back().duration;
}

double duration(const FlightPlan& plan) {
  return plan.empty() ? 0 : end_time_of(plan) - start_of(plan);
}

double ground_length(const FlightElement& e) {
  const double turned = std::abs(e.turn_rate) * e.duration;
  if (turned == 0) return ground_velocity(e, 0).norm() * e.duration;
  if (e.wind.isZero()) return e.airspeed * e.duration;
  // The speed over ground has its sharpest bend where it is least; the nearer the wind is
  // to the airspeed, the finer the pieces.
  const double ratio = std::min(e.wind.norm() / e.airspeed, 0.99);
  const int pieces =
      static_cast<int>(std::ceil(turned / (geo::kPi / 4) * (1 + ratio / (1 - ratio))));
  const double h = e.duration / pieces;
  // Squared, the speed is V^2 + w^2 + 2 V w cos(a), a being the heading from the wind's
  // direction on. From piece to piece a grows evenly: its sine and cosine are turned on.
  const double even = e.airspeed * e.airspeed + e.wind.squaredNorm();
  const double swing = 2 * e.airspeed * e.wind.norm();
  const double first = e.heading - geo::bearing(e.wind);
  const double sin_step = math::sin(e.turn_rate * h),
               cos_step = math::cos(e.turn_rate * h);
  double length = 0;
  for (std::size_t k = 0; k < kGaussPoints.size(); ++k) {
    const double a = first + e.turn_rate * h * (1 + kGaussPoints[k]) / 2;
    double c = math::cos(a), s = math::sin(a), sum = 0;
    for (int i = 0; i < pieces; ++i) {
      sum += std::sqrt(std::max(0.0, even + swing * c));
      const double turned_on = c * cos_step - s * sin_step;
      s = s * cos_step + c * sin_step;
      c = turned_on;
    }
    length += kGaussWeights[k] * h / 2 * sum;
  }
  return length;
}

double ground_length(const FlightPlan& plan) {
  double length = 0;
  for (const FlightElement& e : plan) length += ground_length(e);
  return length;
}

Plan sample(const FlightPlan& plan, const SamplingSteps& steps) {
  Plan points;
  const auto add = [&](double time, const FlightMoment& m) {
    const Time at = Time::from_seconds(time);
    if (!points.empty() && at <= points.back().time) return;
    const bool near =
        !points.empty() && (at - points.back().time).seconds() < kMinBetween;
    if (near && points.size() == 1) {
      points.back().v_N = m.v_N;
      return;
    }
    if (near) points.pop_back();
    points.push_back({at, m.p_N, m.v_N});
  };
  for (std::size_t k = 0; k < plan.size(); ++k) {
    const FlightElement& e = plan[k];
    const double turned = std::abs(e.turn_rate) * e.duration;
    const int pieces = std::max(
        1, static_cast<int>(std::ceil(
               -1e-9 + std::max(turned / steps.turn, e.duration / steps.straight))));
    for (int i = 0; i < pieces; ++i) {
      const double t = e.duration * i / pieces;
      add(e.start + t, moment(e, t));
    }
    if (k + 1 == plan.size() || e.duration <= kCornerTime) continue;
    // The curve turns from one velocity to the other at the corner, not all along `e`.
    const Vec3 change = moment(plan[k + 1], 0).v_N - end_of(e).v_N;
    const double before = e.duration - kCornerTime;
    if (change.norm() > kCorner) add(e.start + before, moment(e, before));
  }
  if (!plan.empty()) add(end_time_of(plan), end_of(plan.back()));
  return points;
}

FlightPlan starting_at(FlightPlan plan, double start) {
  double time = start;
  for (FlightElement& e : plan) {
    e.start = time;
    time += e.duration;
  }
  return plan;
}

void append(FlightPlan& plan, FlightPlan next) {
  if (plan.empty()) {
    plan = std::move(next);
    return;
  }
  next = starting_at(std::move(next), end_time_of(plan));
  plan.insert(plan.end(), next.begin(), next.end());
}

}  // namespace skein::model
