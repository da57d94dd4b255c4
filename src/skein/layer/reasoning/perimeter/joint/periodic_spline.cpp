// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/perimeter/joint/periodic_spline.h"

#include "skein/base/check.h"
#include "skein/base/math.h"
#include "skein/geo/vec.h"

namespace skein::perimeter {

PeriodicSpline::PeriodicSpline(int knots) : knots_(knots), step_(2 * geo::kPi / knots) {
  SKEIN_CHECK(knots >= 8, knots);
}

PeriodicSpline::Tap PeriodicSpline::at(double bearing) const {
  const double position = geo::wrap_2pi(bearing) / step_;
  const int cell = std::min(static_cast<int>(position), knots_ - 1);
  const double t = position - cell;
  const double s = 1 - t;
  Tap tap;
  for (int i = 0; i < 4; ++i)
    tap.index[static_cast<std::size_t>(i)] = (cell + i - 1 + knots_) % knots_;
  tap.value = {s * s * s / 6, (4 - 6 * t * t + 3 * t * t * t) / 6,
               (4 - 6 * s * s + 3 * s * s * s) / 6, t * t * t / 6};
  tap.slope = {-s * s / (2 * step_), (3 * t * t - 4 * t) / (2 * step_),
               (4 * s - 3 * s * s) / (2 * step_), t * t / (2 * step_)};
  return tap;
}

double PeriodicSpline::response(int harmonic) const {
  return (2 + math::cos(harmonic * step_)) / 3;
}

}  // namespace skein::perimeter
