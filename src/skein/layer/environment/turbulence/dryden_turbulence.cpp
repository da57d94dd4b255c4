// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/environment/turbulence/dryden_turbulence.h"

#include <algorithm>
#include <cmath>

#include "skein/base/check.h"
#include "skein/base/math.h"

namespace skein::environment {
namespace {

constexpr double kMinAirspeed = 1;   // [m/s]
constexpr double kTolerance = 0.01;  // relative, before coefficients are renewed
constexpr double kLowAltitude = 1000 * 0.3048, kHighAltitude = 2000 * 0.3048;  // [m]

bool changed(double now, double then) {
  return std::abs(now - then) > kTolerance * then;
}

// Direction of the horizontal velocity through the mean air. The slower it is, the more
// it is taken along the heading: else all gusts would turn round with a vehicle that
// begins to move in hardly any wind.
Vec2 ahead_of(const TurbulenceView& view) {
  const Vec2 v = geo::horizontal(view.vehicle.v_N - view.wind_N);
  const double speed = v.norm();
  if (speed >= kMinAirspeed) return v / speed;
  const Vec2 nose = geo::unit(geo::yaw(view.vehicle.q_NB));
  const Vec2 sum = v + (kMinAirspeed - speed) * nose;
  const double length = sum.norm();
  return length > 1e-3 ? Vec2(sum / length) : nose;
}

// (u, v, w) with u along that direction.
Vec3 along_airspeed(const TurbulenceView& view, const Vec3& gust) {
  const Vec2 ahead = ahead_of(view);
  const Vec2 level = gust.x() * ahead + gust.y() * geo::turned_right(ahead);
  return {level.x(), level.y(), gust.z()};
}

}  // namespace

DrydenTurbulence::DrydenTurbulence(const DrydenOptions& options, std::uint64_t seed,
                                   EntityId entity, std::uint32_t instance)
    : options_(options),
      random_(seed, entity.value, Purpose::kTurbulence, instance),
      calm_(options.wind20 && *options.wind20 <= 0) {
  SKEIN_CHECK(options.span > 0, options.span);
}

void DrydenTurbulence::update(double height, double distance) {
  if (height_ < 0 || changed(height, height_)) {
    spectrum_ = dryden_spectrum(options_, height);
    height_ = height;
  } else if (!changed(distance, distance_)) {
    return;
  }
  distance_ = distance;
  const double b = options_.span, reach = 4 * b / geo::kPi;
  v_.discretise(distance, spectrum_.length_u, 3 * b / geo::kPi);
  w_.discretise(distance, spectrum_.length_w, reach);
  keep_u_ = math::exp(-distance / spectrum_.length_u);
  stir_u_ = std::sqrt(1 - keep_u_ * keep_u_);
  keep_p_ = math::exp(-distance / reach);
  stir_p_ = std::sqrt(1 - keep_p_ * keep_p_);
  // The integral of the spectrum: its value at 0 times pi/(2 reach).
  sigma_p_ = spectrum_.sigma_w *
             std::sqrt(0.8 / spectrum_.length_w * math::cbrt(spectrum_.length_w / reach) *
                       (geo::kPi / 2) / reach);
}

void DrydenTurbulence::step() {
  const auto n = random_.normals4(), m = random_.normals4();
  if (!started_) {
    started_ = true;
    u_ = n[0];
    p_ = m[0];
    v_.start({n[1], n[2], n[3]});
    w_.start({m[1], m[2], m[3]});
    return;
  }
  u_ = keep_u_ * u_ + stir_u_ * n[0];
  p_ = keep_p_ * p_ + stir_p_ * m[0];
  v_.step({n[1], n[2], n[3]});
  w_.step({m[1], m[2], m[3]});
}

Gust DrydenTurbulence::advance(const TurbulenceView& view, double dt) {
  if (calm_) return {};
  const double height = std::max(view.height_agl, 1.0);
  update(height, std::max(view.vehicle.airspeed, kMinAirspeed) * dt);
  step();
  const Vec3 gust{spectrum_.sigma_u * u_, spectrum_.sigma_u * v_.gust(),
                  spectrum_.sigma_w * w_.gust()};
  Gust felt;
  felt.rates_B = {sigma_p_ * p_, -spectrum_.sigma_w * w_.gradient(),
                  spectrum_.sigma_u * v_.gradient()};
  if (height <= kLowAltitude) {
    felt.velocity_N = along_airspeed(view, gust);
  } else {
    const double part =
        std::min((height - kLowAltitude) / (kHighAltitude - kLowAltitude), 1.0);
    felt.velocity_N = part * (view.vehicle.q_NB * gust);
    if (part < 1) felt.velocity_N += (1 - part) * along_airspeed(view, gust);
  }
  return felt;
}

}  // namespace skein::environment
