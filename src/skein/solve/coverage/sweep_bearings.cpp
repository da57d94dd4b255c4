// SPDX-License-Identifier: Apache-2.0
#include "skein/solve/coverage/sweep_bearings.h"

#include <cmath>

#include "skein/solve/coverage/sweep_lines.h"

namespace skein::solve {
namespace {

// Bearings at which the number of lines across the whole area changes, on the side where
// it is smaller.
void add_fewer_lines(const geo::Region& area, double spacing,
                     std::vector<double>& bearings) {
  const auto count = [&](double b) {
    return std::ceil(width_across(area, b) / spacing - 1e-9);
  };
  for (int k = 0; k < 720; ++k) {
    double few = k * kBearingStep, many = few + kBearingStep;
    if (count(few) == count(many)) continue;
    if (count(few) > count(many)) std::swap(few, many);
    const double min = count(few);
    for (int i = 0; i < 30; ++i) {
      const double middle = (few + many) / 2;
      (count(middle) <= min ? few : many) = middle;
    }
    bearings.push_back(half_turn(few));
  }
}

}  // namespace

double half_turn(double bearing) {
  const double b = geo::wrap_2pi(bearing);
  return b >= geo::kPi ? b - geo::kPi : b;
}

std::vector<double> bearings_to_try(const geo::Region& area, double spacing,
                                    const Vec2& wind) {
  std::vector<double> bearings;
  for (int k = 0; k < 720; ++k) bearings.push_back(k * kBearingStep);
  for (const geo::Ring& ring : area)
    for (std::size_t i = 0; i < ring.size() && ring.size() <= 64; ++i)
      bearings.push_back(half_turn(geo::bearing(ring[(i + 1) % ring.size()] - ring[i])));
  if (wind.norm() > 0)
    for (const double turned : {0.0, geo::kPi / 2})
      bearings.push_back(half_turn(geo::bearing(wind) + turned));
  add_fewer_lines(area, spacing, bearings);
  return bearings;
}

}  // namespace skein::solve
