// How FlightEstimator takes in fixes of satellites: what they are trusted, corrections,
// and beginning again from them.

#include <algorithm>
#include <cmath>

#include "skein/data/air.h"
#include "skein/layer/autopilot/estimator/flight_estimator.h"

namespace skein::autopilot {
namespace {

constexpr double kMinFixSd = 0.002;        // of position [m] and velocity [m/s]
constexpr double kCarrier = 0.01;          // errors of its phase to those of the code
constexpr double kSlowShare = 0.05;        // least share of a fix's variance [-]
constexpr double kChangedPrecision = 1.5;  // of a receiver that begins anew

}  // namespace

// A receiver that changes its kind, or states another precision, has another error.
void FlightEstimator::take_precision_of(const GnssFix& fix) {
  const double sd = std::max(fix.position_sd, kMinFixSd);
  const double down = std::max(fix.altitude_sd, kMinFixSd) / sd;
  // By the code, multipath is taken as noise that lasts. By the carrier's phase it is so
  // small that the position moves faster than it does: there it is the error that is
  // followed, since it is most of it, and the noise counts as white.
  const bool phase = fix.kind == GnssKind::kRtk;
  const double fast = phase ? kCarrier : 1;
  const double multipath2 = options_->gnss_multipath_sd * options_->gnss_multipath_sd;
  const double noise2 = options_->gnss_noise_sd * options_->gnss_noise_sd;
  const double fast2 = fast * fast * (noise2 + (phase ? 0 : multipath2));
  const double slow2 = std::max(sd * sd - fast2, kSlowShare * sd * sd);
  const double last2 = gnss_sd_ * gnss_sd_;
  const bool anew = !has_fix_ || fix.kind != fix_.kind ||
                    slow2 > kChangedPrecision * last2 ||
                    slow2 * kChangedPrecision < last2;
  gnss_sd_ = std::sqrt(slow2);
  gnss_time_ = phase ? options_->gnss_multipath_time : options_->gnss_correlation_time;
  multipath_sd_ = phase ? 0 : options_->gnss_multipath_sd;
  gnss_down_ = down;
  gnss_fast_ = fast * std::min(1.0, std::sqrt((1 - kSlowShare) * sd * sd / fast2));
  if (!anew) return;
  last_fix_.any = false;
  x_.gnss_bias.setZero();
  for (std::size_t k = 0; k < 3; ++k) {
    const double slow = k < 2 ? gnss_sd_ : gnss_down_ * gnss_sd_;
    covariance_.restart(error::kGnssBias + k, slow * slow);
  }
}

void FlightEstimator::fuse_fix(ErrorVector& error) {
  Past past{at_fix_.p_N, at_fix_.v_N, std::max(seconds_since(fix_.time), 0.0),
            x_.v_N - at_fix_.v_N};
  past.gained.z() -= past.delay * kGravity;
  const auto fast = [this](double sd, double time) {
    const double sd2 = gnss_fast_ * gnss_fast_ * sd * sd;
    return fix_.kind == GnssKind::kRtk ? sd2 : last_fix_.variance(sd2, time, fix_.time);
  };
  const double variance = fast(multipath_sd_, options_->gnss_multipath_time) +
                          fast(options_->gnss_noise_sd, options_->gnss_noise_time);
  last_fix_.used(fix_.time);
  bool accepted = true;
  for (int k = 0; k < 3; ++k) {
    const Observation z = observe_position(x_, past, k);
    const double scale2 = k < 2 ? 1 : gnss_down_ * gnss_down_;
    const bool fits = fuse(z, fix_.p_N[k] - z.value, scale2 * variance, error);
    accepted = accepted && (fits || k == 2);
  }
  const double velocity_sd = std::max(fix_.velocity_sd, kMinFixSd);
  for (int k = 0; k < 3; ++k) {
    const Observation z = observe_velocity(x_, past, k);
    const bool fits = fuse(z, fix_.v_N[k] - z.value, velocity_sd * velocity_sd, error);
    accepted = accepted && (fits || k == 2);
  }
  if (accepted) accepted_fix_ = fix_.time;
  if (!lasts(fix_rejection_, accepted, options_->gnss_reset_after)) return;
  inject(error);
  error.fill(0);
  begin_again(fix_, past);
}

void FlightEstimator::begin_again(const GnssFix& fix, const Past& past) {
  Vec3 v = fix.v_N + past.gained;
  v.z() += past.delay * kGravity;
  const Vec3 p = fix.p_N + 0.5 * past.delay * (fix.v_N + v);
  history_.clear();
  x_.p_N = p;
  x_.v_N = v;
  x_.gnss_bias.setZero();
  const double velocity_sd = std::max(fix.velocity_sd, kMinFixSd);
  const double fast = gnss_fast_ * multipath_sd_;
  for (std::size_t k = 0; k < 3; ++k) {
    const double scale = k < 2 ? 1 : gnss_down_;
    const double slow2 = scale * scale * gnss_sd_ * gnss_sd_;
    const double fast2 = scale * scale * fast * fast;
    covariance_.restart(error::kVelocity + k, velocity_sd * velocity_sd);
    covariance_.restart(error::kGnssBias + k, slow2);
    covariance_.restart(error::kPosition + k, slow2 + fast2);
    // The position is as wrong as the fix is.
    covariance_.add(error::kPosition + k, error::kGnssBias + k, -slow2);
  }
  accepted_fix_ = fix.time;
}

}  // namespace skein::autopilot
