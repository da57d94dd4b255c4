// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/environment/turbulence/dryden_spectrum.h"

#include <algorithm>
#include <array>

#include <cmath>

#include "skein/base/math.h"

namespace skein::environment {
namespace {

constexpr double kFoot = 0.3048;         // [m]
constexpr double kKnot = 1852.0 / 3600;  // [m/s]
constexpr double kLowest = 10;           // [ft]
constexpr double kLow = 1000;            // [ft]: the low-altitude model ends
constexpr double kHigh = 2000;           // [ft]: the high-altitude model begins
constexpr double kHighLength = 1750;     // [ft]

// Standard deviation [ft/s] by altitude [ft], exceeded with a probability of 1e-2, 1e-3
// and 1e-5, as read off figure 7 of the standard.
struct Exceedance {
  double altitude, light, moderate, severe;
};
constexpr std::array<Exceedance, 12> kExceedance{{{500, 6.6, 8.6, 15.6},
                                                  {1750, 6.9, 9.6, 17.6},
                                                  {3750, 7.4, 10.6, 23.0},
                                                  {7500, 6.7, 10.1, 23.6},
                                                  {15000, 4.6, 8.0, 22.1},
                                                  {25000, 2.7, 6.6, 20.0},
                                                  {35000, 0.4, 5.0, 16.0},
                                                  {45000, 0.0, 4.2, 15.1},
                                                  {55000, 0.0, 2.7, 12.1},
                                                  {65000, 0.0, 0.0, 7.9},
                                                  {75000, 0.0, 0.0, 6.2},
                                                  {80000, 0.0, 0.0, 5.1}}};

Exceedance exceedance_at(double altitude) {
  std::size_t above = 1;
  while (above + 1 < kExceedance.size() && kExceedance[above].altitude < altitude)
    ++above;
  const Exceedance& a = kExceedance[above - 1];
  const Exceedance& b = kExceedance[above];
  const double part =
      std::clamp((altitude - a.altitude) / (b.altitude - a.altitude), 0.0, 1.0);
  return {altitude, std::lerp(a.light, b.light, part),
          std::lerp(a.moderate, b.moderate, part), std::lerp(a.severe, b.severe, part)};
}

double wind_20ft(const DrydenOptions& options) {
  if (options.wind20) return *options.wind20;
  return (15 + 15 * static_cast<double>(options.intensity)) * kKnot;
}

// [m/s] at an altitude [ft]: between the words as W20 is between theirs.
double high_sigma(double w20, double altitude) {
  const Exceedance e = exceedance_at(altitude);
  const double step = w20 / (15 * kKnot);  // 1 = light, 2 = moderate, 3 = severe
  const double sigma = step < 1   ? step * e.light
                       : step < 2 ? std::lerp(e.light, e.moderate, step - 1)
                                  : std::lerp(e.moderate, e.severe, step - 2);
  return sigma * kFoot;
}

}  // namespace

DrydenSpectrum dryden_spectrum(const DrydenOptions& options, double height) {
  const double w20 = wind_20ft(options);
  const double h = std::max(height / kFoot, kLowest);
  const double low_h = std::min(h, kLow);
  const double growth = math::pow(0.177 + 0.000823 * low_h, 0.4);
  const double sigma_w = 0.1 * w20;
  DrydenSpectrum s{low_h / (growth * growth * growth) * kFoot, low_h * kFoot,
                   sigma_w / growth, sigma_w};
  if (h <= kLow) return s;
  const double part = std::min((h - kLow) / (kHigh - kLow), 1.0);
  const double length = std::lerp(kLow, kHighLength, part) * kFoot;
  const double sigma = std::lerp(sigma_w, high_sigma(w20, std::max(h, kHigh)), part);
  return {length, length, sigma, sigma};
}

}  // namespace skein::environment
