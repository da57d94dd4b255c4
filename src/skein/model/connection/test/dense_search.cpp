// SPDX-License-Identifier: Apache-2.0
#include "skein/model/connection/test/dense_search.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "skein/base/random.h"
#include "skein/model/path/flight_plan.h"

namespace skein::model::test {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr double kTurn = 2 * geo::kPi;
constexpr int kBranches = 8;  // CCC words have two middle arcs

double mod(double angle) {
  const double a = std::fmod(angle, kTurn);
  const double positive = a < 0 ? a + kTurn : a;
  return positive > kTurn - 1e-11 ? 0 : positive;
}

// Reduced problem with counter-clockwise positive: start at the origin along x.
struct Case {
  Vec2 goal, wind;
  double phi;

  // Length in radii of a branch when the goal has moved for `time`; NaN without one.
  double length(int branch, double time) const {
    const Vec2 g = goal - wind * time;
    const double d = g.norm(), theta = d == 0 ? 0 : std::atan2(g.y(), g.x());
    const double a = mod(-theta), b = mod(phi - theta);
    const double sa = std::sin(a), sb = std::sin(b), ca = std::cos(a), cb = std::cos(b);
    const double cab = std::cos(a - b);
    const auto root = [](double square) {
      return square > -1e-12 ? std::sqrt(std::max(0.0, square)) : std::nan("");
    };
    switch (branch) {
      case 0: {  // LSL
        const double p = root(2 + d * d - 2 * cab + 2 * d * (sa - sb));
        const double h = std::atan2(cb - ca, d + sa - sb);
        return mod(-a + h) + p + mod(b - h);
      }
      case 1: {  // RSR
        const double p = root(2 + d * d - 2 * cab + 2 * d * (sb - sa));
        const double h = std::atan2(ca - cb, d - sa + sb);
        return mod(a - h) + p + mod(-b + h);
      }
      case 2: {  // LSR
        const double p = root(-2 + d * d + 2 * cab + 2 * d * (sa + sb));
        const double h = std::atan2(-ca - cb, d + sa + sb) - std::atan2(-2.0, p);
        return mod(-a + h) + p + mod(-b + h);
      }
      case 3: {  // RSL
        const double p = root(-2 + d * d + 2 * cab - 2 * d * (sa + sb));
        const double h = std::atan2(ca + cb, d - sa - sb) - std::atan2(2.0, p);
        return mod(a - h) + p + mod(b - h);
      }
      default: {
        const bool rlr = branch < 6;
        const double side = rlr ? 1 : -1;
        const double c = (6 - d * d + 2 * cab + side * 2 * d * (sa - sb)) / 8;
        if (std::abs(c) > 1) return std::nan("");
        const double p = branch % 2 == 0 ? std::acos(c) : kTurn - std::acos(c);
        // The mirror image of RLR is LRL.
        const double ma = rlr ? a : mod(-a), mb = rlr ? b : mod(-b);
        const double h =
            std::atan2(std::cos(ma) - std::cos(mb), d - std::sin(ma) + std::sin(mb));
        const double t = mod(ma - h + p / 2);
        return t + p + mod(ma - mb - t + p);
      }
    }
  }
  double spare(int branch, double time) const { return time - length(branch, time); }
};

double bisect(const Case& c, int branch, double level, double low, double high) {
  for (int i = 0; i < 80; ++i) {
    const double middle = (low + high) / 2;
    const double g = c.spare(branch, middle);
    if (std::isnan(g)) return kNever;
    (g < level ? low : high) = middle;
  }
  // A jump is no meeting.
  return std::abs(c.spare(branch, high) - level) < 1e-7 ? high : kNever;
}

}  // namespace

double dense_search(const ConnectionQuery& q, double until, int steps) {
  // With y to the left of the start, turns to the left are positive.
  const Vec2 along = geo::unit(q.from.course);
  const auto reduced = [&](const Vec2& v) {
    return Vec2(along.dot(v), -geo::cross(along, v));
  };
  const Case c{reduced(q.to.position - q.from.position) / q.air.turn_radius,
               reduced(q.air.wind) / q.air.airspeed, mod(q.from.course - q.to.course)};
  const double unit = q.air.turn_radius / q.air.airspeed;
  const double end = until / unit;
  double best = kNever;
  for (int branch = 0; branch < kBranches; ++branch) {
    double last = c.spare(branch, 0), before = last;
    if (std::abs(last) < 1e-9) best = std::min(best, 0.0);
    for (int i = 1; i <= steps; ++i) {
      const double low = end * (i - 1) / steps, high = end * i / steps;
      if (low >= best) break;
      const double g = c.spare(branch, high);
      if (!std::isnan(g) && !std::isnan(last)) {
        // Spare time that is a whole number of turns is spent on loops.
        for (double level = 0; level <= g; level += kTurn)
          if (last < level) best = std::min(best, bisect(c, branch, level, low, high));
        // A maximum just below a level may hide two meetings: look closer.
        if (last > before && last > g && last < 0 && last > -0.3) {
          const double from = end * std::max(0, i - 2) / steps;
          for (int k = 1; k <= 200; ++k) {
            const double t = from + (high - from) * k / 200;
            if (c.spare(branch, t) >= 0)
              best = std::min(best, bisect(c, branch, 0, t - (high - from) / 200, t));
          }
        }
      }
      before = last;
      last = g;
    }
  }
  return best * unit;
}

ConnectionQuery random_case(std::uint32_t number) {
  RandomStream random(number, 0, Purpose::kTest);
  const double rho = 20 + 100 * random.uniform(), box = (number % 2 == 0 ? 20 : 4) * rho;
  const auto place = [&]() -> Vec2 {
    return box * Vec2(random.uniform(), random.uniform());
  };
  ConnectionQuery q;
  q.air = {10 + 20 * random.uniform(), rho, Vec2::Zero()};
  q.air.wind =
      q.air.airspeed * 0.95 * random.uniform() * geo::unit(kTurn * random.uniform());
  q.from = {place(), kTurn * random.uniform()};
  q.to = {place(), kTurn * random.uniform()};
  return q;
}

// Close goals within four radii in strong wind, goals at the start, headings along the
// axes, opposite or equal, places on whole numbers of radii (circles that touch), goals
// straight up and down the wind and along the heading, and no wind.
ConnectionQuery hard_case(std::uint32_t number) {
  RandomStream random(number, 1, Purpose::kTest);
  const auto pick = [&](int n) { return static_cast<int>(n * random.uniform()); };
  const double rho = 50;
  ConnectionQuery q;
  const double ratio = std::array{
      0.0, 0.3, 0.8, 0.95, 0.95 * random.uniform()}[static_cast<std::size_t>(pick(5))];
  const auto heading = [&] {
    return pick(3) == 0 ? kTurn * random.uniform() : geo::kPi / 4 * pick(8);
  };
  const double downwind = heading();
  q.air = {20, rho, 20 * ratio * geo::unit(downwind)};
  q.from = {{500, -300}, heading()};
  switch (pick(6)) {
    case 0:
      q.to.position = q.from.position;
      break;
    case 1:
      q.to.position = q.from.position + rho * Vec2(pick(9) - 4, pick(9) - 4);
      break;
    case 2:
      q.to.position = q.from.position + rho * 4 * random.uniform() *
                                            geo::unit(q.from.course + geo::kPi * pick(2));
      break;
    case 3:
      q.to.position =
          q.from.position + 4 * rho * (random.uniform() - 0.5) * q.air.wind.normalized();
      break;
    default:
      q.to.position = q.from.position +
                      4 * rho * random.uniform() * geo::unit(kTurn * random.uniform());
  }
  q.to.course = pick(2) == 0 ? heading() : q.from.course + geo::kPi * pick(2);
  return q;
}

ConnectionQuery extreme_case(std::uint32_t number) {
  RandomStream random(number, 2, Purpose::kTest);
  const auto magnitude = [&](double low, double high) {
    return std::pow(10.0, random.uniform(low, high));
  };
  const double downwind = number % 5 == 0
                              ? geo::kPi / 2 * std::floor(4 * random.uniform())
                              : random.uniform(0, kTurn);
  const double ratio = number % 3 == 0   ? 1 - magnitude(-9, 0)
                       : number % 3 == 1 ? 0.999 * magnitude(-12, 0)
                                         : 0;
  ConnectionQuery q;
  q.air = {magnitude(-1, 2.5), magnitude(-1, 4), Vec2::Zero()};
  q.air.wind = q.air.airspeed * ratio * geo::unit(downwind);
  q.from.course = random.uniform(-10, 10);
  const double offset = number % 7 == 0   ? q.from.course
                        : number % 7 == 1 ? downwind
                                          : random.uniform(0, kTurn);
  q.to.position = magnitude(-9, 4) * q.air.turn_radius * geo::unit(offset);
  q.to.course = number % 6 == 0   ? q.from.course
                : number % 6 == 1 ? q.from.course + geo::kPi
                                  : random.uniform(0, kTurn);
  return q;
}

double end_error(const ConnectionQuery& q, const Connection& c) {
  if (c.status != ConnectionStatus::kFound) return kNever;
  const FlightPlan plan = to_flight_plan(c, q.from, q.air);
  FlightMoment end;
  end.p_N.head<2>() = q.from.position;
  end.heading = q.from.course;
  if (!plan.empty()) end = end_of(plan.back());
  return std::max((geo::horizontal(end.p_N) - q.to.position).norm() / q.air.turn_radius,
                  std::abs(geo::wrap_pi(end.heading - q.to.course)));
}

}  // namespace skein::model::test
