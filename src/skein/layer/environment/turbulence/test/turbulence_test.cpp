// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <functional>
#include <limits>

#include "skein/layer/environment/turbulence/discrete_gusts.h"
#include "skein/layer/environment/turbulence/dryden_turbulence.h"
#include "skein/layer/environment/turbulence/gusts.h"

namespace skein::environment::turbulence_test {
namespace {

constexpr double kFoot = 0.3048;

// A vehicle heading north through still air, so that u, v, w are north, east, down.
struct Flight {
  VehicleState vehicle;
  double height = 30;
  Vec3 wind_N = Vec3::Zero();

  explicit Flight(double airspeed = 20) { fly(airspeed); }
  void fly(double airspeed) {
    vehicle.airspeed = airspeed;
    vehicle.v_N = {airspeed, 0, 0};
  }
  TurbulenceView at(Time now = {}) const { return {now, vehicle, height, wind_N}; }
};

// The standard's one-sided spectra over spatial frequency [rad/m], in its own words.
using Spectrum = std::function<double(double)>;
struct Standard {
  double length_u, length_w, sigma_u, sigma_w, span;

  double u(double o) const {
    return sigma_u * sigma_u * 2 * length_u / geo::kPi / (1 + std::pow(length_u * o, 2));
  }
  double transverse(double o, double length, double sigma) const {
    const double l2 = std::pow(length * o, 2);
    return sigma * sigma * length / geo::kPi * (1 + 3 * l2) / std::pow(1 + l2, 2);
  }
  double v(double o) const { return transverse(o, length_u, sigma_u); }
  double w(double o) const { return transverse(o, length_w, sigma_w); }
  double smooth(double o, double spans) const {
    return 1 / (1 + std::pow(spans * span * o / geo::kPi, 2));
  }
  double p(double o) const {
    return sigma_w * sigma_w * 0.8 / length_w *
           std::cbrt(geo::kPi * length_w / (4 * span)) * smooth(o, 4);
  }
  double q(double o) const { return o * o * smooth(o, 4) * w(o); }
  double r(double o) const { return o * o * smooth(o, 3) * v(o); }

  std::array<Spectrum, 6> all() const {
    const auto of = [this](double (Standard::*f)(double) const) {
      return [this, f](double o) { return (this->*f)(o); };
    };
    return {of(&Standard::u), of(&Standard::v), of(&Standard::w),
            of(&Standard::p), of(&Standard::q), of(&Standard::r)};
  }
};

// Low altitude, wind at 20 ft 10 m/s, 30 m up.
Standard standard_at_30m(double span) {
  const double h = 30 / kFoot;
  const double growth = 0.177 + 0.000823 * h;
  return {h / std::pow(growth, 1.2) * kFoot, 30, 1 / std::pow(growth, 0.4), 1.0, span};
}

std::array<double, 6> components(const Gust& gust) {
  return {gust.velocity_N.x(), gust.velocity_N.y(), gust.velocity_N.z(),
          gust.rates_B.x(),    gust.rates_B.y(),    gust.rates_B.z()};
}

// Integral from 0 to infinity, over t with omega = tan(t)/scale; midpoints.
double integral(const Spectrum& f, double scale) {
  const int n = 200000;
  double sum = 0;
  for (int i = 0; i < n; ++i) {
    const double t = (i + 0.5) * geo::kPi / 2 / n;
    sum += f(std::tan(t) / scale) / (scale * std::pow(std::cos(t), 2));
  }
  return sum * geo::kPi / 2 / n;
}

TEST(DrydenSpectrum, HasTheLowAltitudeForms) {
  const auto s = dryden_spectrum({.wind20 = 10}, 200 * kFoot);
  const double growth = 0.177 + 0.000823 * 200;
  EXPECT_NEAR(s.length_w, 200 * kFoot, 1e-9);
  EXPECT_NEAR(s.length_u, 200 / std::pow(growth, 1.2) * kFoot, 1e-9);
  EXPECT_NEAR(s.sigma_w, 1, 1e-12);
  EXPECT_NEAR(s.sigma_u, 1 / std::pow(growth, 0.4), 1e-12);
  // Words: 15, 30, 45 kt at 20 ft.
  EXPECT_NEAR(dryden_spectrum({}, 20).sigma_w, 1.5 * 1852 / 3600, 1e-12);
  EXPECT_NEAR(dryden_spectrum({.intensity = TurbulenceIntensity::kSevere}, 20).sigma_w,
              4.5 * 1852 / 3600, 1e-12);
  // Nothing changes below 10 ft.
  EXPECT_EQ(dryden_spectrum({}, 0).length_w, dryden_spectrum({}, 10 * kFoot).length_w);
}

TEST(DrydenSpectrum, HasTheHighAltitudeTable) {
  const auto at = [](TurbulenceIntensity i, double feet) {
    return dryden_spectrum({.intensity = i}, feet * kFoot);
  };
  const auto light = at(TurbulenceIntensity::kLight, 3750);
  EXPECT_NEAR(light.length_u, 1750 * kFoot, 1e-9);
  EXPECT_NEAR(light.length_w, 1750 * kFoot, 1e-9);
  EXPECT_NEAR(light.sigma_u, 7.4 * kFoot, 1e-9);
  EXPECT_EQ(light.sigma_u, light.sigma_w);
  EXPECT_NEAR(at(TurbulenceIntensity::kModerate, 7500).sigma_w, 10.1 * kFoot, 1e-9);
  EXPECT_NEAR(at(TurbulenceIntensity::kSevere, 11250).sigma_w, 22.85 * kFoot, 1e-9);
  EXPECT_EQ(at(TurbulenceIntensity::kLight, 90000).sigma_w, 0);
  // Half way between the words' winds, half way between their intensities.
  EXPECT_NEAR(dryden_spectrum({.wind20 = 22.5 * 1852 / 3600}, 3750 * kFoot).sigma_w,
              9.0 * kFoot, 1e-9);
}

TEST(DrydenSpectrum, IsContinuousInHeight) {
  for (const auto intensity :
       {TurbulenceIntensity::kLight, TurbulenceIntensity::kModerate,
        TurbulenceIntensity::kSevere}) {
    DrydenSpectrum before = dryden_spectrum({.intensity = intensity}, 0);
    for (int h = 1; h < 10000; ++h) {
      const auto now = dryden_spectrum({.intensity = intensity}, h);
      // The steepest parts: length_u near the ground 4.7 m, intensities 0.05 m/s, a
      // metre.
      EXPECT_LT(std::abs(now.length_u - before.length_u), 9) << h;
      EXPECT_LT(std::abs(now.length_w - before.length_w), 1.01) << h;
      EXPECT_LT(std::abs(now.sigma_u - before.sigma_u), 0.1) << h;
      EXPECT_LT(std::abs(now.sigma_w - before.sigma_w), 0.1) << h;
      before = now;
    }
  }
}

// Variances of all six against the integrals of the standard's spectra, for steps from 2
// cm to 60 m of path: the step does not matter.
TEST(DrydenTurbulence, VariancesAreTheStandardsAtAnyStep) {
  const double span = 2;
  const Standard standard = standard_at_30m(span);
  const auto spectra = standard.all();
  for (const double dt : {0.001, 0.01, 0.1, 3.0}) {
    // Independent runs, each sampled once after 40 steps: errors of sqrt(2/n) exactly.
    const int n = 8000;
    std::array<double, 6> variance{};
    Flight flight;
    for (std::uint32_t run = 0; run < n; ++run) {
      DrydenTurbulence turbulence({.wind20 = 10, .span = span}, 1, {run});
      Gust gust;
      for (int i = 0; i < 40; ++i) gust = turbulence.advance(flight.at(), dt);
      const auto c = components(gust);
      for (std::size_t k = 0; k < 6; ++k) variance[k] += c[k] * c[k] / n;
    }
    for (std::size_t k = 0; k < 6; ++k) {
      const double expected = integral(spectra[k], k < 2 ? 150 : k == 5 ? 5 : 10);
      // 4.5 standard errors of 1.6 %.
      EXPECT_NEAR(variance[k] / expected, 1, 0.072) << "component " << k << " dt " << dt;
    }
  }
}

// Averaged periodograms against the standard's spectra, folded at the sampling rate.
TEST(DrydenTurbulence, SpectraAreTheStandards) {
  const double span = 3, dt = 0.1, airspeed = 20;
  const Standard standard = standard_at_30m(span);
  const auto spectra = standard.all();
  const int length = 1024, pieces = 1500;
  const std::array<int, 5> bins{8, 25, 80, 200, 420};  // 0.08 to 4.1 Hz
  std::array<std::array<double, 5>, 6> power{};
  std::vector<double> window(length);
  double window2 = 0;
  for (int i = 0; i < length; ++i) {
    window[static_cast<std::size_t>(i)] =
        0.5 - 0.5 * std::cos(2 * geo::kPi * (i + 0.5) / length);
    window2 += std::pow(window[static_cast<std::size_t>(i)], 2);
  }
  std::array<std::vector<std::complex<double>>, 5> waves;
  for (std::size_t b = 0; b < 5; ++b)
    for (int i = 0; i < length; ++i)
      waves[b].push_back(window[static_cast<std::size_t>(i)] *
                         std::polar(1.0, -2 * geo::kPi * bins[b] * i / length));

  DrydenTurbulence turbulence({.wind20 = 10, .span = span}, 11, {1});
  const Flight flight(airspeed);
  for (int piece = 0; piece < pieces; ++piece) {
    std::array<std::array<std::complex<double>, 5>, 6> sum{};
    for (std::size_t i = 0; i < length; ++i) {
      const auto c = components(turbulence.advance(flight.at(), dt));
      for (std::size_t k = 0; k < 6; ++k)
        for (std::size_t b = 0; b < 5; ++b) sum[k][b] += c[k] * waves[b][i];
    }
    // Two-sided density over angular frequency: |X|^2 dt/(2 pi sum of window^2).
    for (std::size_t k = 0; k < 6; ++k)
      for (std::size_t b = 0; b < 5; ++b)
        power[k][b] += std::norm(sum[k][b]) * dt / (2 * geo::kPi * window2) / pieces;
  }
  for (std::size_t k = 0; k < 6; ++k) {
    for (std::size_t b = 0; b < 5; ++b) {
      const double omega = 2 * geo::kPi * bins[b] / (length * dt);
      double folded = 0;
      for (int m = -2000; m <= 2000; ++m)
        folded +=
            spectra[k](std::abs(omega + 2 * geo::kPi * m / dt) / airspeed) / airspeed / 2;
      // Each piece has a relative spread of 1: 2.6 % standard error, bound at 4.5 of
      // them.
      EXPECT_NEAR(power[k][b] / folded, 1, 0.116) << "component " << k << " bin " << b;
    }
  }
}

// Covariances over a distance: the spectra's own length scales.
TEST(DrydenTurbulence, CorrelationFallsOverTheLengthScales) {
  const Standard standard = standard_at_30m(2);
  const Flight flight;
  const int n = 20000;
  for (const double share : {0.5, 1.0, 2.0}) {
    double u = 0, w = 0;
    for (std::uint32_t run = 0; run < n; ++run) {
      DrydenTurbulence turbulence({.wind20 = 10}, 5, {run});
      const double dt_u = share * standard.length_u / 20;
      const double u0 = turbulence.advance(flight.at(), dt_u).velocity_N.x();
      u += u0 * turbulence.advance(flight.at(), dt_u).velocity_N.x() / n;
      DrydenTurbulence other({.wind20 = 10}, 6, {run});
      const double dt_w = share * standard.length_w / 20;
      const double w0 = other.advance(flight.at(), dt_w).velocity_N.z();
      w += w0 * other.advance(flight.at(), dt_w).velocity_N.z() / n;
    }
    // Longitudinal exp(-s/L), transverse (1 - s/2L) exp(-s/L); a product of two normals
    // has a spread of at most sqrt(2): 4.5 standard errors of 1 %.
    EXPECT_NEAR(u / std::pow(standard.sigma_u, 2), std::exp(-share), 0.045);
    EXPECT_NEAR(w, (1 - share / 2) * std::exp(-share), 0.045);
  }
}

TEST(DrydenTurbulence, ComponentsAreIndependentOfEachOther) {
  const Flight flight;
  const int n = 10000;
  std::array<std::array<double, 6>, 6> covariance{};
  for (std::uint32_t run = 0; run < n; ++run) {
    DrydenTurbulence turbulence({.wind20 = 10}, 8, {run});
    turbulence.advance(flight.at(), 0.01);
    const auto c = components(turbulence.advance(flight.at(), 0.01));
    for (std::size_t i = 0; i < 6; ++i)
      for (std::size_t j = 0; j < 6; ++j) covariance[i][j] += c[i] * c[j] / n;
  }
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      // w and q, v and r are of one filter: a quantity and its smoothed slope, whose
      // correlation need not vanish.
      if ((i == 4 && j == 2) || (i == 5 && j == 1)) continue;
      EXPECT_NEAR(covariance[i][j] / std::sqrt(covariance[i][i] * covariance[j][j]), 0,
                  4.5 / std::sqrt(n))
          << i << " " << j;
    }
  }
}

// The rates are slopes of the gusts along the path: with a span far below the scales,
// their sums give the gusts back.
TEST(DrydenTurbulence, RatesAreTheSlopesOfTheGusts) {
  const Flight flight;
  DrydenTurbulence turbulence({.wind20 = 10, .span = 0.05}, 2, {1});
  const double dt = 1e-4;  // 2 mm of path, the smoothing reaches over 64 mm
  const Gust first = turbulence.advance(flight.at(), dt);
  double down = 0, right = 0;
  Gust gust;
  for (int i = 0; i < 20000; ++i) {
    gust = turbulence.advance(flight.at(), dt);
    down -= gust.rates_B.y() * 20 * dt;
    right += gust.rates_B.z() * 20 * dt;
  }
  // What smoothing leaves out: the change of a gust over 64 mm, sigma sqrt(3 s/L) at
  // most.
  EXPECT_NEAR(down, gust.velocity_N.z() - first.velocity_N.z(), 0.25);
  EXPECT_NEAR(right, gust.velocity_N.y() - first.velocity_N.y(), 0.25);
  EXPECT_GT(std::abs(down) + std::abs(right), 0.6);  // there was something to find
}

TEST(DrydenTurbulence, StaysInItsSteadyStateWhenSpeedAndHeightChange) {
  const int n = 4000;
  std::array<double, 6> fast{}, steady{};
  for (std::uint32_t run = 0; run < n; ++run) {
    DrydenTurbulence turbulence({.wind20 = 10}, 3, {run});
    Flight flight;
    Gust gust;
    for (int i = 0; i <= 200; ++i) {
      flight.fly(20 + 10 * std::sin(0.1 * i));
      flight.height = 60 + 30 * std::cos(0.05 * geo::kPi * i);  // ends at 90 m
      gust = turbulence.advance(flight.at(), 0.02);
    }
    const auto c = components(gust);
    DrydenTurbulence level({.wind20 = 10}, 4, {run});
    Flight even(flight.vehicle.airspeed);
    even.height = flight.height;
    const auto d = components(level.advance(even.at(), 0.02));
    for (std::size_t k = 0; k < 6; ++k) {
      fast[k] += c[k] * c[k] / n;
      steady[k] += d[k] * d[k] / n;
    }
  }
  // Two variances of 4,000 each: relative standard error of their ratio 3.2 %; bound at
  // 4.5 of them.
  for (std::size_t k = 0; k < 6; ++k)
    EXPECT_NEAR(fast[k] / steady[k], 1, 0.145) << "component " << k;
}

TEST(DrydenTurbulence, WithoutIntensityThereIsNone) {
  DrydenTurbulence turbulence({.wind20 = 0}, 1, {1});
  const Flight flight;
  for (int i = 0; i < 100; ++i) {
    const Gust gust = turbulence.advance(flight.at(), 0.01);
    EXPECT_EQ(gust.velocity_N, Vec3::Zero());
    EXPECT_EQ(gust.rates_B, Vec3::Zero());
  }
}

TEST(DrydenTurbulence, LowGustsFollowThePathAndHighOnesTheBody) {
  // The same stream under different attitudes: in components of the right axes the gusts
  // are the same.
  const auto first = [](const Flight& flight) {
    DrydenTurbulence turbulence({}, 1, {1});
    return turbulence.advance(flight.at(), 0.01).velocity_N;
  };
  Flight north;
  north.vehicle.q_NB = geo::from_euler({0.5, 0.2, 1});  // whatever it looks at
  const Vec3 uvw = first(north);
  Flight east;
  east.vehicle.v_N = {3, 25, 1};
  east.wind_N = {3, 5, 0};  // course through the air: due east
  const Vec3 turned = first(east);
  EXPECT_NEAR(turned.y(), uvw.x(), 1e-12);
  EXPECT_NEAR(turned.x(), -uvw.y(), 1e-12);
  EXPECT_NEAR(turned.z(), uvw.z(), 1e-12);

  Flight high = north;
  high.height = 1000;
  Flight level_high = high;
  level_high.vehicle.q_NB = Quat::Identity();
  EXPECT_LT((first(high) - high.vehicle.q_NB * first(level_high)).norm(), 1e-12);
}

TEST(DrydenTurbulence, IsOfItsEntityAndSeed) {
  const auto run = [](std::uint64_t seed, std::uint32_t entity, std::uint32_t instance) {
    DrydenTurbulence turbulence({}, seed, {entity}, instance);
    const Flight flight;
    Gust gust;
    for (int i = 0; i < 100; ++i) gust = turbulence.advance(flight.at(), 0.01);
    return gust.velocity_N;
  };
  EXPECT_EQ(run(1, 1, 0), run(1, 1, 0));
  EXPECT_NE(run(1, 1, 0), run(1, 2, 0));
  EXPECT_NE(run(1, 1, 0), run(2, 1, 0));
  EXPECT_NE(run(1, 1, 0), run(1, 1, 1));
}

TEST(DrydenTurbulence, IsFiniteWhereItsFormulasMeetTheirLimits) {
  // On the ground, without airspeed, with a span for which both lengths of the filter
  // agree (10 ft = 4 b/pi), very fast and very high.
  for (const double span : {0.1, 2.0, 10 * kFoot * geo::kPi / 4, 60.0}) {
    for (const double height : {-1.0, 0.0, 3.048, 500.0, 30000.0}) {
      for (const double airspeed : {0.0, 20.0, 300.0}) {
        DrydenTurbulence turbulence(
            {.intensity = TurbulenceIntensity::kSevere, .span = span}, 1, {1});
        Flight flight(airspeed);
        flight.height = height;
        for (int i = 0; i < 300; ++i) {
          const Gust gust = turbulence.advance(flight.at(), 0.01);
          ASSERT_TRUE(gust.velocity_N.allFinite() && gust.rates_B.allFinite())
              << span << " " << height << " " << airspeed;
          ASSERT_LT(gust.velocity_N.norm(), 6 * 10.0);  // 6 sigma
        }
      }
    }
  }
}

TEST(DiscreteGusts, HaveTheCosineShape) {
  const DiscreteGust gust{.length = 40, .hold = 10};
  EXPECT_EQ(gust_share(gust, 0), 0);
  EXPECT_NEAR(gust_share(gust, 10), (1 - std::sqrt(0.5)) / 2, 1e-15);
  EXPECT_NEAR(gust_share(gust, 20), 0.5, 1e-15);
  EXPECT_EQ(gust_share(gust, 45), 1);
  EXPECT_NEAR(gust_share(gust, 70), 0.5, 1e-15);
  EXPECT_EQ(gust_share(gust, 90), 0);
  const DiscreteGust stays{.length = 40, .hold = std::numeric_limits<double>::infinity()};
  EXPECT_NEAR(gust_share(stays, 20), 0.5, 1e-15);
  EXPECT_EQ(gust_share(stays, 1e6), 1);
}

TEST(DiscreteGusts, SlopeIsTheDerivativeOfTheShare) {
  const DiscreteGust gust{.length = 40, .hold = 10};
  for (double distance = 0.5; distance < 100; distance += 1.3) {
    const double h = 1e-5;
    EXPECT_NEAR(
        gust_slope(gust, distance),
        (gust_share(gust, distance + h) - gust_share(gust, distance - h)) / (2 * h), 1e-8)
        << distance;
  }
}

TEST(DiscreteGusts, TurnTheAirWhereTheyChange) {
  // Half way in, flying east: a gust from the south blows from the right, v < 0 growing
  // more negative ahead; a downdraught, w > 0, grows ahead: the air pitches down.
  DiscreteGusts gusts({.gusts = {{.amplitude = {6, 0, 3}, .length = 30}}});
  VehicleState vehicle;
  vehicle.airspeed = 15;
  vehicle.q_NB = geo::from_euler({0, 0, geo::kPi / 2});
  gusts.advance({Time(), vehicle, 100, Vec3::Zero()}, 1);
  const Gust felt = gusts.advance({Time::from_seconds(1), vehicle, 100, Vec3::Zero()}, 1);
  const double slope = geo::kPi / 60;
  EXPECT_NEAR(felt.rates_B.x(), 0, 1e-12);
  EXPECT_NEAR(felt.rates_B.y(), -3 * slope, 1e-12);
  EXPECT_NEAR(felt.rates_B.z(), -6 * slope, 1e-12);
}

TEST(DiscreteGusts, AreMetAlongThePathFromTheirStart) {
  DiscreteGusts gusts({.gusts = {{.start = 1, .amplitude = {0, 6, 0}, .length = 30},
                                 {.start = 1.5,
                                  .amplitude = {0, 0, 2},
                                  .frame = GustFrame::kBody,
                                  .length = 10}}});
  Flight flight(15);
  flight.vehicle.q_NB = geo::from_euler({geo::kPi / 2, 0, 0});  // its down is west
  for (int i = 0; i < 600; ++i) {
    const double t = 0.01 * i;
    const Vec3 felt =
        gusts.advance(flight.at(Time::from_ns(10'000'000LL * i)), 0.01).velocity_N;
    const auto share = [](double distance, double length) {
      return distance <= 0 || distance >= 2 * length
                 ? 0.0
                 : (1 - std::cos(geo::kPi * distance / length)) / 2;
    };
    const double expected = 6 * share(15 * (t - 1), 30) - 2 * share(15 * (t - 1.5), 10);
    EXPECT_NEAR(felt.y(), expected, 1e-9) << t;
    EXPECT_NEAR(std::hypot(felt.x(), felt.z()), 0, 1e-12);
  }
}

TEST(Gusts, AddUpTheirParts) {
  const Flight flight;
  const DrydenOptions options;
  const DiscreteGust gust{.amplitude = {1, 2, 3}, .length = 5};
  std::vector<std::unique_ptr<Turbulence>> parts;
  parts.push_back(std::make_unique<DrydenTurbulence>(options, 1, EntityId{1}));
  parts.push_back(std::make_unique<DiscreteGusts>(DiscreteGustsOptions{.gusts = {gust}}));
  Gusts sum(std::move(parts));
  DrydenTurbulence dryden(options, 1, {1});
  DiscreteGusts discrete({.gusts = {gust}});
  for (int i = 0; i < 20; ++i) {
    const auto view = flight.at(Time::from_ns(10'000'000LL * i));
    const Gust both = sum.advance(view, 0.01);
    const Gust a = dryden.advance(view, 0.01), b = discrete.advance(view, 0.01);
    EXPECT_EQ(both.velocity_N, Vec3(a.velocity_N + b.velocity_N));
    EXPECT_EQ(both.rates_B, Vec3(a.rates_B + b.rates_B));
  }
}

}  // namespace
}  // namespace skein::environment::turbulence_test
