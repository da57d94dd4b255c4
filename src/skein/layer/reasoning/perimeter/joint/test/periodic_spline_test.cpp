// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/perimeter/joint/periodic_spline.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "skein/geo/vec.h"

namespace skein::perimeter::periodic_spline_test {
namespace {

double value(const PeriodicSpline& spline, const std::vector<double>& c, double bearing) {
  const PeriodicSpline::Tap tap = spline.at(bearing);
  double sum = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    sum += tap.value[i] * c[static_cast<std::size_t>(tap.index[i])];
  }
  return sum;
}

TEST(PeriodicSpline, ShowsHarmonicsToTheStatedAccuracy) {
  const PeriodicSpline spline(60);
  for (const int k : {0, 1, 3, 8}) {
    std::vector<double> c;
    for (int j = 0; j < 60; ++j)
      c.push_back(std::cos(k * j * spline.step()) / spline.response(k));
    // The stated bound, doubled for the bearings between the knots.
    const double bound = 2 * std::pow(k * spline.step(), 4) / 384 + 1e-12;
    for (double bearing = -7; bearing < 7; bearing += 0.0137) {
      EXPECT_NEAR(value(spline, c, bearing), std::cos(k * bearing), bound)
          << k << " " << bearing;
    }
  }
}

TEST(PeriodicSpline, SlopeIsTheDerivative) {
  const PeriodicSpline spline(24);
  std::vector<double> c;
  for (int j = 0; j < 24; ++j) c.push_back(std::sin(1.7 * j * j));
  for (double bearing = 0; bearing < 6.28; bearing += 0.0173) {
    const PeriodicSpline::Tap tap = spline.at(bearing);
    double slope = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      slope += tap.slope[i] * c[static_cast<std::size_t>(tap.index[i])];
    }
    // Central difference of a piecewise cubic: error (1e-5)^2 times its third derivative.
    const double numeric =
        (value(spline, c, bearing + 1e-5) - value(spline, c, bearing - 1e-5)) / 2e-5;
    EXPECT_NEAR(slope, numeric, 1e-3) << bearing;
  }
}

}  // namespace
}  // namespace skein::perimeter::periodic_spline_test
