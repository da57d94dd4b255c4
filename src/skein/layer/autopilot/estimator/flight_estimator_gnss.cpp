// SPDX-License-Identifier: Apache-2.0
// How FlightEstimator takes in fixes of satellites: what they are trusted, corrections,
// and beginning again from them.

#include <algorithm>
#include <cmath>

#include "skein/base/math.h"
#include "skein/data/vehicle/air.h"
#include "skein/layer/autopilot/estimator/flight_estimator.h"

namespace skein::autopilot {
namespace {

constexpr double kMinFixSd = 0.002;        // of position [m] and velocity [m/s]
constexpr double kCarrier = 0.01;          // errors of its phase to those of the code
constexpr double kSlowShare = 0.05;        // minimum share of a fix's variance [-]
constexpr double kChangedPrecision = 1.5;  // of a receiver that begins anew

// A filter that is right has innovations of mean square 1.
constexpr double kMaxSquare = 30;        // of one fix: a single one proves nothing
constexpr double kInnovationTime = 3;    // over which it is smoothed [s]
constexpr double kMaxShare = 0.1;        // of one fix, however long after the last
constexpr double kAlignFor = 2;          // of flight, for the attitude [s]
constexpr double kAlignGap = 1;          // between fixes, to begin the search again [s]
constexpr double kFoundTilt = 0.05;      // sd of a found attitude [rad]
constexpr double kFoundHeading = 0.1;    // sd by the field [rad]
constexpr double kGuessedHeading = 0.5;  // sd without it [rad]
constexpr double kFreshField = 0.5;      // [s]
constexpr double kUnknownWind = 5;       // sd [m/s]

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
  const bool anew = !has_fix_ || fix.kind != fix_.kind || fix.unit != fix_.unit ||
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
    const bool fits = fuse(z, fix_.p_N[k] - z.value, scale2 * variance, error).accepted;
    accepted = accepted && (fits || k == 2);
  }
  const double velocity_sd = std::max(fix_.velocity_sd, kMinFixSd);
  double square = 0;
  for (int k = 0; k < 3; ++k) {
    const Observation z = observe_velocity(x_, past, k);
    const Fused fits = fuse(z, fix_.v_N[k] - z.value, velocity_sd * velocity_sd, error);
    accepted = accepted && (fits.accepted || k == 2);
    square += std::min(fits.square, kMaxSquare) / 3;
  }
  if (accepted) accepted_fix_ = fix_.time;
  if (contradicted(square)) {
    inject(error);
    error.fill(0);
    find_attitude(past);
    return;
  }
  if (!lasts(fix_rejection_, accepted, options_->gnss_reset_after)) return;
  inject(error);
  error.fill(0);
  begin_again(fix_, past);
}

// Smooths the squares of the fixes' innovations, and says whether a search for the
// attitude is at its end with this fix.
bool FlightEstimator::contradicted(double mean_square) {
  const double since = has_judged_ ? (fix_.time - judged_).seconds() : kInnovationTime;
  judged_ = fix_.time;
  has_judged_ = true;
  innovation_ratio_ +=
      std::min(since / kInnovationTime, kMaxShare) * (mean_square - innovation_ratio_);
  if (!alignment_ ? innovation_ratio_ < kDiverged : since > kAlignGap) {
    alignment_.reset();
    return false;
  }
  if (!alignment_) {
    x_.gyro_bias.setZero();
    x_.accel_bias.setZero();
    alignment_.emplace(nav_.time, fix_.v_N);
  }
  return seconds_since(alignment_->begin()) >= kAlignFor;
}

// The field shows the heading, as far as its dip is known; without it the nose of a wing
// points where it flies through the air, and that of a rotorcraft where it was believed.
void FlightEstimator::find_attitude(const Past& past) {
  const bool field = field_seconds_ > 0 && seconds_since(field_time_) < kFreshField;
  Vec3 u_B = Vec3::UnitX(), u_N = x_.q_NB * Vec3::UnitX();
  if (field) {
    u_B = field_B_;
    u_N = {field_level_ * math::cos(options_->declination),
           field_level_ * math::sin(options_->declination), field_down_};
  } else if (options_->fixed_wing) {
    u_N = fix_.v_N - nav_.wind_N;
  }
  const auto found = alignment_->attitude(nav_.time, fix_.v_N, u_B, u_N);
  if (!found) return;
  alignment_.reset();
  ++counts_.alignments;
  innovation_ratio_ = 1;
  take_attitude(*found, field ? kFoundHeading : kGuessedHeading);
  begin_again(fix_, past);
  // These were held against the old state.
  altitude_.count = field_N_.count = airspeed_.count = wind_N_.count = 0;
}

// What the old attitude has taught of the sensors and the wind goes with it.
void FlightEstimator::take_attitude(const Quat& q_NB, double heading_sd) {
  const auto three = [this](std::size_t at, double sd) {
    for (std::size_t k = 0; k < 3; ++k) covariance_.restart(at + k, sd * sd);
  };
  x_.q_NB = q_NB;
  x_.magnetic_bias.setZero();
  field_seconds_ = 0;
  three(error::kAttitude, kFoundTilt);
  covariance_.restart(error::kAttitude + 2, heading_sd * heading_sd);
  three(error::kGyroBias, options_->gyro_bias_sd);
  three(error::kAccelBias, options_->accel_bias_sd);
  three(error::kMagneticBias, options_->magnetic_bias_sd);
  covariance_.restart(error::kWind, kUnknownWind * kUnknownWind);
  covariance_.restart(error::kWind + 1, kUnknownWind * kUnknownWind);
  gusts_along_ = gusts_across_ = gusts_north_ = gusts_east_ = first_gusts();
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
