// SPDX-License-Identifier: Apache-2.0
// What FlightEstimator does once a period: covariance and corrections.

#include <algorithm>

#include "skein/base/math.h"
#include "skein/data/vehicle/air.h"
#include "skein/layer/autopilot/estimator/flight_estimator.h"

namespace skein::autopilot {
namespace {

constexpr double kGetUsed = 3;           // after which a new force is the usual one [s]
constexpr double kSwing = 1;             // faster motion to and fro does not last [s]
constexpr double kLongRejection = 10;    // of bearings or altitudes [s]
constexpr double kMinLevelField = 0.05;  // of the unit field
constexpr double kLeg = 30;              // of flight with one attitude [s]
constexpr double kWildTilt = 0.1;        // sd of the tilt [rad]
constexpr double kFieldMemory = 20;      // of the field's dip [s]
constexpr double kDoubtful = 2;          // mean square of the fixes' innovations

}  // namespace

void FlightEstimator::correct() {
  propagate();
  ErrorVector error{};
  if (fix_waits_) fuse_fix(error);
  if (altitude_.count > 0) fuse_altitude(error);
  if (field_N_.count > 0) fuse_bearing(error);
  fuse_air_data(error);
  inject(error);
  fix_waits_ = false;
  altitude_.count = field_N_.count = airspeed_.count = wind_N_.count = 0;
  step_ = {};
}

void FlightEstimator::propagate() {
  const double dt = step_.dt;
  if (dt <= 0) return;
  Transition step{step_, {}, {}};
  const auto square = [](double x) { return x * x; };
  step.decay.fill(1);
  // Gauss-Markov: decay exp(-dt/tau), whose stationary variance stays as it is.
  const auto wander = [&](std::size_t i, double time, double sd) {
    const double x = dt / time;
    const double phi = 1 - x + 0.5 * x * x;
    step.decay[i] = phi;
    step.noise[i] = sd * sd * (1 - phi * phi);
  };
  for (std::size_t k = 0; k < 3; ++k)
    wander(error::kGnssBias + k, gnss_time_, k < 2 ? gnss_sd_ : gnss_down_ * gnss_sd_);
  wander(error::kBaroBias, options_->baro_correlation_time, options_->baro_bias_sd);
  x_.gnss_bias *= step.decay[error::kGnssBias];
  x_.baro_bias *= step.decay[error::kBaroBias];

  for (std::size_t k = 0; k < 3; ++k) {
    step.noise[error::kGyroBias + k] = square(options_->gyro_bias_walk) * dt;
    step.noise[error::kAccelBias + k] = square(options_->accel_bias_walk) * dt;
    step.noise[error::kMagneticBias + k] = square(options_->magnetic_bias_walk) * dt;
    step.noise[error::kAttitude + k] = square(options_->gyro_noise) * dt;
    step.noise[error::kVelocity + k] = square(options_->accel_noise) * dt;
  }
  step.noise[error::kAirspeedScale] = square(options_->airspeed_scale_walk) * dt;
  for (std::size_t k = 0; k < 2; ++k)
    step.noise[error::kWind + k] = square(options_->wind_walk) * dt;
  add_scale_noise(step);
  covariance_.propagate(step);
}

// A wrong scale k adds k (f + g) to the bias along each axis of B. When a manoeuvre
// changes f by df for long, the bias so becomes another, by k df: that comes in as noise
// of the bias while the usual force follows the present one. What swings to and fro
// cancels out.
void FlightEstimator::add_scale_noise(Transition& step) {
  const double share = std::min(step_.dt / kSwing, 1.0);
  const double follow = std::min(step_.dt / kGetUsed, 1.0);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto at = static_cast<Eigen::Index>(axis);
    double f = 0;  // mean along the axis
    for (std::size_t k = 0; k < 3; ++k) f += step_.A[k][axis] * step_.s[k];
    f /= step_.dt * step_.dt;
    lasting_f_[at] += share * (f - lasting_f_[at]);
    const double change = options_->accel_scale_sd * (lasting_f_[at] - usual_f_[at]);
    usual_f_[at] += follow * (lasting_f_[at] - usual_f_[at]);
    // The change dies away with kGetUsed: in all this comes to k^2 df^2.
    step.noise[error::kAccelBias + axis] += follow * (2 - follow) * change * change;
  }
}

FlightEstimator::Fused FlightEstimator::fuse(const Observation& z, double innovation,
                                             double variance, ErrorVector& error) {
  ErrorVector ph;
  const double s = covariance_.project(z.row, ph) + variance;
  const double left = innovation - z.row.dot(error);
  const double square = left * left / s;
  if (square > options_->gate * options_->gate) {
    ++counts_.rejected;
    return {false, square};
  }
  const double scale = left / s;
  for (std::size_t i = 0; i < error::kSize; ++i) error[i] += scale * ph[i];
  covariance_.reduce(ph, s);
  return {true, square};
}

bool FlightEstimator::lasts(Rejection& rejection, bool accepted, double limit) {
  if (!accepted && !rejection.now) rejection.since = nav_.time;
  rejection.now = !accepted;
  if (accepted || seconds_since(rejection.since) < limit) return false;
  rejection.now = false;
  ++counts_.resets;
  return true;
}

double FlightEstimator::Coloured::variance(double sd2, double tau, Time now) const {
  if (!any) return sd2;
  // (1 + phi) / (1 - phi) = coth(x)
  const double x = 0.5 * (now - last).seconds() / tau;
  if (x > 0.25) return sd2 / math::tanh(x);
  return sd2 * (1 / x + x * (1.0 / 3 - x * x / 45));  // to 1e-6
}

void FlightEstimator::fuse_altitude(ErrorVector& error) {
  const Observation z = observe_altitude(x_);
  const double innovation = altitude_.mean();
  const double white = options_->baro_noise * options_->baro_noise / altitude_.count;
  const bool accepted = fuse(z, innovation, white, error).accepted;
  if (lasts(altitude_rejection_, accepted, kLongRejection))
    covariance_.add(error::kBaroBias, innovation * innovation);
}

void FlightEstimator::fuse_bearing(ErrorVector& error) {
  const Vec3 m_N = field_N_.mean() - x_.q_NB * x_.magnetic_bias;
  const double level = math::hypot(m_N.x(), m_N.y());
  if (level < kMinLevelField) return;  // straight down: no bearing
  // The field dips: when the tilt is unknown a bearing says little, and not linearly.
  if (covariance_.variance(error::kAttitude) +
          covariance_.variance(error::kAttitude + 1) >
      kWildTilt * kWildTilt)
    return;
  // An uncertain attitude would teach a wrong dip.
  if (innovation_ratio_ < kDoubtful || field_seconds_ <= 0) {
    field_seconds_ = std::min(field_seconds_ + options_->period, kFieldMemory);
    const double share = options_->period / field_seconds_;
    field_level_ += share * (level - field_level_);
    field_down_ += share * (m_N.z() - field_down_);
  }
  const Vec3 field_N(field_level_ * math::cos(options_->declination),
                     field_level_ * math::sin(options_->declination), field_down_);
  const double innovation =
      geo::wrap_pi(math::atan2(m_N.y(), m_N.x()) - options_->declination);
  const double white = options_->magnetic_noise * options_->magnetic_noise /
                       (field_level_ * field_level_ * field_N_.count);
  // Many bearings in straight flight determine heading and bias together far better than
  // their product is small: it is an error that lasts.
  const double lasting = last_bearing_.variance(bearing_curvature(), kLeg, nav_.time);
  last_bearing_.used(nav_.time);
  const bool accepted =
      fuse(observe_bearing(x_, field_N), innovation, white + lasting, error).accepted;
  if (lasts(bearing_rejection_, accepted, kLongRejection))
    covariance_.add(error::kAttitude + 2, innovation * innovation);
}

// Variance of what the gradient of the bearing leaves out: with theta and the error e of
// the magnetometer's bias in N, the field h along x and m_z down, that is
// (theta_y (theta_x h + theta_z m_z) / 2 - theta_z e_x + theta_x e_z) / h.
double FlightEstimator::bearing_curvature() const {
  const Mat3 R = x_.q_NB.toRotationMatrix();
  const auto bias = [&](Eigen::Index axis) {
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double r = R(axis, static_cast<Eigen::Index>(k));
      sum += r * r * covariance_.variance(error::kMagneticBias + k);
    }
    return sum;
  };
  const double level2 = field_level_ * field_level_;
  const double down2 = field_down_ * field_down_;
  const double tilt = 0.5 * (covariance_.variance(error::kAttitude) +
                             covariance_.variance(error::kAttitude + 1));
  const double heading = covariance_.variance(error::kAttitude + 2);
  return (0.25 * tilt * (tilt * level2 + heading * down2) +
          heading * 0.5 * (bias(0) + bias(1)) + tilt * bias(2)) /
         level2;
}

void FlightEstimator::inject(const ErrorVector& error) {
  const auto three = [&error](std::size_t at) {
    return Vec3(error[at], error[at + 1], error[at + 2]);
  };
  history_.correct(nav_.time, x_.v_N, three(error::kPosition), three(error::kVelocity),
                   three(error::kAttitude), x_.q_NB * three(error::kAccelBias));
  // What no measurement can show (in straight flight: heading with the magnetometer's
  // bias, tilt with the accelerometers') are fixed directions of the error in N, biases
  // included. Those stay what they are in N while the estimated attitude turns: else the
  // directions would turn with each correction, and a little would seem to be seen of
  // all.
  const Mat3 back =
      geo::exp_so3(x_.q_NB.conjugate() * -three(error::kAttitude)).toRotationMatrix();
  for (std::size_t at : {error::kGyroBias, error::kAccelBias, error::kMagneticBias})
    covariance_.turn(at, back);
  x_ = corrected(x_, error);
  publish(nav_.w_NB_B);
}

}  // namespace skein::autopilot
