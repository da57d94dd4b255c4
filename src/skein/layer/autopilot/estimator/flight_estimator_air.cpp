// SPDX-License-Identifier: Apache-2.0
// How FlightEstimator takes in what it feels of the air: pitot tube, side-slip and
// anemometer, through gusts of a strength that it estimates.

#include <algorithm>
#include <cmath>

#include "skein/layer/autopilot/estimator/flight_estimator.h"

namespace skein::autopilot {
namespace {

constexpr double kSideslipTime = 5;   // over which side-slip lasts [s]
constexpr double kFreshAirspeed = 1;  // [s]
constexpr double kOblique = 0.06;     // of airspeed, by air that comes from aside
constexpr double kWildGust = 10;      // innovations above say nothing of gusts [m/s]
constexpr double kRolls = 2;          // over ground: a wing that no longer stands [m/s]

}  // namespace

void FlightEstimator::fuse_air_data(ErrorVector& error) {
  if (wind_N_.count > 0) {
    // An anemometer feels the same gusts as pitot and fin do, and says more: it counts
    // alone.
    const double white =
        options_->anemometer_noise * options_->anemometer_noise / wind_N_.count;
    const Vec3 seen = wind_N_.mean();
    for (int k = 0; k < 2; ++k)
      fuse_through_gusts(observe_wind(x_, k), seen[k] - x_.wind_N[k], white, 0,
                         k == 0 ? gusts_north_ : gusts_east_, error);
    return;
  }
  // The tube of a wing that stands feels the stronger gusts only: not the mean wind.
  if (options_->fixed_wing && !coordinated_ && nav_.v_N.norm() < kRolls) return;
  const double speed = (nav_.v_N - nav_.wind_N).norm();
  if (airspeed_.count > 0) {
    const double white =
        options_->airspeed_noise * options_->airspeed_noise / airspeed_.count;
    if (coordinated_ || !options_->fixed_wing) {
      fuse_through_gusts(observe_airspeed(x_), airspeed_.mean(), white, 0, gusts_along_,
                         error);
    } else {
      // The tube feels what comes from ahead; airspeed_ was held against all of it.
      const Observation z = observe_airspeed_ahead(x_);
      const double seen = airspeed_.mean() + observe_airspeed(x_).value;
      const double oblique = kOblique * seen;
      fuse_through_gusts(z, seen - z.value, white + oblique * oblique, 0, gusts_along_,
                         error);
    }
  }
  const double measured = has_airspeed_ && seconds_since(airspeed_time_) < kFreshAirspeed
                              ? nav_.airspeed
                              : speed;
  if (options_->fixed_wing && coordinated_ && measured > options_->min_airspeed) {
    const Observation z = observe_sideslip(x_);
    fuse_through_gusts(z, -z.value, 0, options_->sideslip_sd * speed, gusts_across_,
                       error);
  }
}

void FlightEstimator::fuse_through_gusts(const Observation& z, double innovation,
                                         double white, double sideslip, Gusts& gusts,
                                         ErrorVector& error) {
  const double dt = step_.dt;
  if (dt <= 0) return;
  const double min = options_->min_gust_sd * options_->min_gust_sd;
  const double variance = std::max(gusts.variance, min);
  const double slip2 = sideslip * sideslip;
  // What innovations vary by beyond everything else is gusts.
  ErrorVector ph;
  const double known = covariance_.project(z.row, ph) + white + slip2;
  const double left = innovation - z.row.dot(error);
  const double excess = std::min(left * left, kWildGust * kWildGust) - known;
  gusts.seconds = std::min(gusts.seconds + dt, options_->gust_memory);
  gusts.variance += dt / gusts.seconds * (excess - gusts.variance);

  const double speed = std::max((nav_.v_N - nav_.wind_N).norm(), 1.0);
  const double coloured =
      gusts.last.variance(variance, options_->gust_length / speed, nav_.time) +
      gusts.last.variance(slip2, kSideslipTime, nav_.time);
  gusts.last.used(nav_.time);
  fuse(z, innovation, white + coloured, error);
}

}  // namespace skein::autopilot
