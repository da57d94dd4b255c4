// What FlightEstimator does once a period: covariance and corrections.

#include <algorithm>
#include <cmath>

#include "data/air.h"
#include "layer/autopilot/estimator/flight_estimator.h"

namespace skein::autopilot {
namespace {

constexpr double kLeastFixSd = 0.002;      // of position [m] and velocity [m/s]
constexpr double kGetUsed = 3;             // after which a new force is the usual one [s]
constexpr double kSwing = 1;               // faster motion to and fro does not last [s]
constexpr double kSideslipTime = 5;        // over which side-slip lasts [s]
constexpr double kFreshAirspeed = 1;       // [s]
constexpr double kMoves = 3;               // over ground: below it may be parked [m/s]
constexpr double kLongRejection = 10;      // of bearings or altitudes [s]
constexpr double kCarrier = 0.01;          // errors of its phase to those of the code
constexpr double kSlowShare = 0.05;        // least share of a fix's variance [-]
constexpr double kChangedPrecision = 1.5;  // of a receiver that begins anew
constexpr double kLeastLevelField = 0.05;  // of the unit field
constexpr double kLeg = 30;                // of flight with one attitude [s]
constexpr double kWildTilt = 0.1;          // sd of the tilt [rad]
constexpr double kFieldMemory = 20;        // of the field's dip [s]
constexpr double kWildGust = 10;           // innovations above say nothing of gusts [m/s]

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
  wander(error::kBaroBias, options_.baro_correlation_time, options_.baro_bias_sd);
  x_.gnss_bias *= step.decay[error::kGnssBias];
  x_.baro_bias *= step.decay[error::kBaroBias];

  for (std::size_t k = 0; k < 3; ++k) {
    step.noise[error::kGyroBias + k] = square(options_.gyro_bias_walk) * dt;
    step.noise[error::kAccelBias + k] = square(options_.accel_bias_walk) * dt;
    step.noise[error::kMagneticBias + k] = square(options_.magnetic_bias_walk) * dt;
    step.noise[error::kAttitude + k] = square(options_.gyro_noise) * dt;
    step.noise[error::kVelocity + k] = square(options_.accel_noise) * dt;
  }
  step.noise[error::kAirspeedScale] = square(options_.airspeed_scale_walk) * dt;
  for (std::size_t k = 0; k < 2; ++k)
    step.noise[error::kWind + k] = square(options_.wind_walk) * dt;
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
    const double change = options_.accel_scale_sd * (lasting_f_[at] - usual_f_[at]);
    usual_f_[at] += follow * (lasting_f_[at] - usual_f_[at]);
    // The change dies away with kGetUsed: in all this comes to k^2 df^2.
    step.noise[error::kAccelBias + axis] += follow * (2 - follow) * change * change;
  }
}

bool FlightEstimator::fuse(const Observation& z, double innovation, double variance,
                           ErrorVector& error) {
  ErrorVector ph;
  const double s = covariance_.project(z.row, ph) + variance;
  const double left = innovation - z.row.dot(error);
  if (left * left > options_.gate * options_.gate * s) {
    ++counts_.rejected;
    return false;
  }
  const double scale = left / s;
  for (std::size_t i = 0; i < error::kSize; ++i) error[i] += scale * ph[i];
  covariance_.reduce(ph, s);
  return true;
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
  if (x > 0.25) return sd2 / std::tanh(x);
  return sd2 * (1 / x + x * (1.0 / 3 - x * x / 45));  // to 1e-6
}

// A receiver that changes its kind, or states another precision, has another error.
void FlightEstimator::take_precision_of(const GnssFix& fix) {
  const double sd = std::max(fix.position_sd, kLeastFixSd);
  const double down = std::max(fix.altitude_sd, kLeastFixSd) / sd;
  // By the code, multipath is taken as noise that lasts. By the carrier's phase it is so
  // small that the position moves faster than it does: there it is the error that is
  // followed, since it is most of it, and the noise counts as white.
  const bool phase = fix.kind == GnssKind::kRtk;
  const double fast = phase ? kCarrier : 1;
  const double multipath2 = options_.gnss_multipath_sd * options_.gnss_multipath_sd;
  const double noise2 = options_.gnss_noise_sd * options_.gnss_noise_sd;
  const double fast2 = fast * fast * (noise2 + (phase ? 0 : multipath2));
  const double slow2 = std::max(sd * sd - fast2, kSlowShare * sd * sd);
  const double last2 = gnss_sd_ * gnss_sd_;
  const bool anew = !has_fix_ || fix.kind != fix_.kind ||
                    slow2 > kChangedPrecision * last2 ||
                    slow2 * kChangedPrecision < last2;
  gnss_sd_ = std::sqrt(slow2);
  gnss_time_ = phase ? options_.gnss_multipath_time : options_.gnss_correlation_time;
  multipath_sd_ = phase ? 0 : options_.gnss_multipath_sd;
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
  const double variance = fast(multipath_sd_, options_.gnss_multipath_time) +
                          fast(options_.gnss_noise_sd, options_.gnss_noise_time);
  last_fix_.used(fix_.time);
  bool accepted = true;
  for (int k = 0; k < 3; ++k) {
    const Observation z = observe_position(x_, past, k);
    const double scale2 = k < 2 ? 1 : gnss_down_ * gnss_down_;
    const bool fits = fuse(z, fix_.p_N[k] - z.value, scale2 * variance, error);
    accepted = accepted && (fits || k == 2);
  }
  const double velocity_sd = std::max(fix_.velocity_sd, kLeastFixSd);
  for (int k = 0; k < 3; ++k) {
    const Observation z = observe_velocity(x_, past, k);
    const bool fits = fuse(z, fix_.v_N[k] - z.value, velocity_sd * velocity_sd, error);
    accepted = accepted && (fits || k == 2);
  }
  if (accepted) accepted_fix_ = fix_.time;
  if (!lasts(fix_rejection_, accepted, options_.gnss_reset_after)) return;
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
  const double velocity_sd = std::max(fix.velocity_sd, kLeastFixSd);
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

void FlightEstimator::fuse_altitude(ErrorVector& error) {
  const Observation z = observe_altitude(x_);
  const double innovation = altitude_.mean();
  const double white = options_.baro_noise * options_.baro_noise / altitude_.count;
  const bool accepted = fuse(z, innovation, white, error);
  if (lasts(altitude_rejection_, accepted, kLongRejection))
    covariance_.add(error::kBaroBias, innovation * innovation);
}

void FlightEstimator::fuse_bearing(ErrorVector& error) {
  const Vec3 m_N = field_N_.mean() - x_.q_NB * x_.magnetic_bias;
  const double level = std::hypot(m_N.x(), m_N.y());
  if (level < kLeastLevelField) return;  // straight down: no bearing
  // The field dips: when the tilt is unknown a bearing says little, and not linearly.
  if (covariance_.variance(error::kAttitude) +
          covariance_.variance(error::kAttitude + 1) >
      kWildTilt * kWildTilt)
    return;
  field_seconds_ = std::min(field_seconds_ + options_.period, kFieldMemory);
  const double share = options_.period / field_seconds_;
  field_level_ += share * (level - field_level_);
  field_down_ += share * (m_N.z() - field_down_);
  const Vec3 field_N(field_level_ * std::cos(options_.declination),
                     field_level_ * std::sin(options_.declination), field_down_);
  const double innovation =
      geo::wrap_pi(std::atan2(m_N.y(), m_N.x()) - options_.declination);
  const double white = options_.magnetic_noise * options_.magnetic_noise /
                       (field_level_ * field_level_ * field_N_.count);
  // Many bearings in straight flight tell heading and bias together far better than their
  // product is small: it is an error that lasts.
  const double lasting = last_bearing_.variance(bearing_curvature(), kLeg, nav_.time);
  last_bearing_.used(nav_.time);
  const bool accepted =
      fuse(observe_bearing(x_, field_N), innovation, white + lasting, error);
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

void FlightEstimator::fuse_air_data(ErrorVector& error) {
  if (wind_N_.count > 0) {
    // An anemometer feels the same gusts as pitot and fin do, and says more: it counts
    // alone.
    const double white =
        options_.anemometer_noise * options_.anemometer_noise / wind_N_.count;
    const Vec3 seen = wind_N_.mean();
    for (int k = 0; k < 2; ++k)
      fuse_through_gusts(observe_wind(x_, k), seen[k] - x_.wind_N[k], white, 0,
                         k == 0 ? gusts_north_ : gusts_east_, error);
    return;
  }
  const double speed = (nav_.v_N - nav_.wind_N).norm();
  if (airspeed_.count > 0) {
    const double white =
        options_.airspeed_noise * options_.airspeed_noise / airspeed_.count;
    fuse_through_gusts(observe_airspeed(x_), airspeed_.mean(), white, 0, gusts_along_,
                       error);
  }
  const double measured = has_airspeed_ && seconds_since(airspeed_time_) < kFreshAirspeed
                              ? nav_.airspeed
                              : speed;
  const bool parked = x_.v_N.squaredNorm() < kMoves * kMoves;
  if (options_.fixed_wing && measured > options_.airspeed_least && !parked) {
    const Observation z = observe_sideslip(x_);
    fuse_through_gusts(z, -z.value, 0, options_.sideslip_sd * speed, gusts_across_,
                       error);
  }
}

void FlightEstimator::fuse_through_gusts(const Observation& z, double innovation,
                                         double white, double sideslip, Gusts& gusts,
                                         ErrorVector& error) {
  const double dt = step_.dt;
  if (dt <= 0) return;
  const double least = options_.gust_sd_least * options_.gust_sd_least;
  const double variance = std::max(gusts.variance, least);
  const double slip2 = sideslip * sideslip;
  // What innovations vary by beyond everything else is gusts.
  ErrorVector ph;
  const double known = covariance_.project(z.row, ph) + white + slip2;
  const double left = innovation - z.row.dot(error);
  const double excess = std::min(left * left, kWildGust * kWildGust) - known;
  gusts.seconds = std::min(gusts.seconds + dt, options_.gust_memory);
  gusts.variance += dt / gusts.seconds * (excess - gusts.variance);

  const double speed = std::max((nav_.v_N - nav_.wind_N).norm(), 1.0);
  const double coloured =
      gusts.last.variance(variance, options_.gust_length / speed, nav_.time) +
      gusts.last.variance(slip2, kSideslipTime, nav_.time);
  gusts.last.used(nav_.time);
  fuse(z, innovation, white + coloured, error);
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
