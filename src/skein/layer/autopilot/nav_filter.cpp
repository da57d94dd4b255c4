// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/autopilot/nav_filter.h"

#include <algorithm>
#include <cmath>

namespace skein::autopilot {
namespace {

constexpr double kDriftLag = 1;        // of the drift, against the noise of fixes [s]
constexpr double kDriftNoise = 0.3;    // random walk of dead reckoning [m/sqrt(s)]
constexpr double kStaleAirData = 0.5;  // a turn rate older than this says nothing [s]

}  // namespace

NavFilter::NavFilter(const NavEstimate& initial, double wind_lag)
    : estimate_(initial),
      wind_lag_(wind_lag),
      airspeed_((geo::horizontal(initial.v_N) - initial.wind_N).norm()),
      climb_rate_(-initial.v_N.z()),
      drift_(initial.wind_N),
      variance_(initial.position_sd * initial.position_sd),
      fix_sd_(initial.position_sd),
      fix_altitude_sd_(initial.altitude_sd),
      fix_time_(initial.time),
      air_time_(initial.time) {}

Vec2 NavFilter::air_velocity(double heading) const {
  const double level2 = airspeed_ * airspeed_ - climb_rate_ * climb_rate_;
  return std::sqrt(std::max(level2, 0.0)) * geo::unit(heading);
}

void NavFilter::advance(Time now) {
  const double dt = (now - estimate_.time).seconds();
  if (dt <= 0) return;
  estimate_.time = now;
  if ((now - air_time_).seconds() > kStaleAirData) turn_rate_ = 0;
  const Vec2 mean_air = air_velocity(estimate_.heading + turn_rate_ * dt / 2);
  estimate_.p_N.head<2>() += dt * (mean_air + drift_);
  estimate_.p_N.z() -= dt * climb_rate_;
  estimate_.heading = geo::wrap_pi(estimate_.heading + turn_rate_ * dt);
  estimate_.v_N.head<2>() = air_velocity(estimate_.heading) + drift_;
  estimate_.v_N.z() = -climb_rate_;
  variance_ += kDriftNoise * kDriftNoise * dt;
  const double age = (now - fix_time_).seconds();
  const double drifted = kDriftNoise * kDriftNoise * age;
  estimate_.position_sd = std::sqrt(fix_sd_ * fix_sd_ + drifted);
  estimate_.altitude_sd = std::sqrt(fix_altitude_sd_ * fix_altitude_sd_ + drifted);
}

void NavFilter::add(const AirDataSample& sample) {
  const double since = (sample.time - air_time_).seconds();
  advance(sample.time);
  if (has_air_ && since > 0 && since <= kStaleAirData) {
    const double last = estimate_.heading - turn_rate_ * since;
    turn_rate_ = geo::wrap_pi(sample.heading - last) / since;
  }
  has_air_ = true;
  air_time_ = sample.time;
  airspeed_ = sample.airspeed;
  estimate_.heading = sample.heading;
  estimate_.v_N.head<2>() = air_velocity(estimate_.heading) + drift_;
}

void NavFilter::add(const GnssFix& fix) {
  const double since = (fix.time - fix_time_).seconds();
  advance(fix.time);
  climb_rate_ = -fix.v_N.z();
  const double fix_variance = fix.position_sd * fix.position_sd;
  const double gain = has_fix_ && variance_ + fix_variance > 0
                          ? variance_ / (variance_ + fix_variance)
                          : 1.0;
  estimate_.p_N += gain * (fix.p_N - estimate_.p_N);
  variance_ = has_fix_ ? (1 - gain) * variance_ : fix_variance;
  fix_sd_ = fix.position_sd;
  fix_altitude_sd_ = fix.altitude_sd;

  if (has_air_) {
    const Vec2 seen = geo::horizontal(fix.v_N) - air_velocity(estimate_.heading);
    // Until enough time has passed for the lags, the plain mean.
    fixes_seconds_ += has_fix_ ? since : 0;
    const auto share = [&](double lag) {
      return has_fix_ && since > 0 ? since / std::min(lag + since, fixes_seconds_ + since)
                                   : 1.0;
    };
    drift_ += share(kDriftLag) * (seen - drift_);
    estimate_.wind_N += share(wind_lag_) * (seen - estimate_.wind_N);
  }
  has_fix_ = true;
  fix_time_ = fix.time;
  estimate_.v_N.head<2>() = air_velocity(estimate_.heading) + drift_;
  estimate_.v_N.z() = fix.v_N.z();
  estimate_.position_sd = fix_sd_;
  estimate_.altitude_sd = fix_altitude_sd_;
}

}  // namespace skein::autopilot
