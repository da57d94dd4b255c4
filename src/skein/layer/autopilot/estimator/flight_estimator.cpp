// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/autopilot/estimator/flight_estimator.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "skein/base/math.h"
#include "skein/data/vehicle/air.h"
#include "skein/layer/autopilot/estimator/strapdown.h"

namespace skein::autopilot {
namespace {

constexpr double kHeldGap = 0.1;         // over which the last rates may be held [s]
constexpr double kLongGap = 1;           // after which the attitude is found anew [s]
constexpr double kGapAcceleration = 3;   // that may have been missed in a gap [m/s^2]
constexpr double kGapTurnRate = 0.3;     // likewise [rad/s]
constexpr double kAirspeedLag = 0.3;     // of the airspeed's offset by gusts [s]
constexpr double kStale = 1;             // age at which a reading counts no more [s]
constexpr double kUnknownHeading = 0.5;  // sd before the first bearing [rad]
constexpr double kRestTilt = 2e-3;       // sd of the tilt by gravity, but for biases
constexpr double kShakenTilt = 0.1;      // the same of what never came to rest [rad]
constexpr double kShaken = 5;            // standard deviations that no sensor at rest has
constexpr double kMaxRestWait = 20;      // for rest [s]

bool finite(const Vec3& v) {
  return std::isfinite(v.sum());
}

void set_three(ErrorCovariance& p, std::size_t at, double sd) {
  for (std::size_t k = 0; k < 3; ++k) p.restart(at + k, sd * sd);
}

}  // namespace

FlightEstimator::FlightEstimator(std::shared_ptr<const EstimatorOptions> options,
                                 const EstimatorStart& start)
    : options_(std::move(options)),
      gusts_along_(first_gusts()),
      gusts_across_(gusts_along_),
      gusts_north_(gusts_along_),
      gusts_east_(gusts_along_),
      accepted_fix_(start.time),
      airspeed_time_(start.time),
      height_time_(start.time),
      field_time_(start.time),
      align_from_(start.time),
      aligning_(start.at_rest),
      coordinated_(!start.at_rest) {
  x_.p_N = start.p_N;
  x_.v_N = start.v_N;
  x_.q_NB = start.q_NB.normalized();
  x_.wind_N = start.wind_N;
  set_three(covariance_, error::kGyroBias, options_->gyro_bias_sd);
  set_three(covariance_, error::kAccelBias, options_->accel_bias_sd);
  set_three(covariance_, error::kGyroScale, options_->gyro_scale_sd);
  set_three(covariance_, error::kMagneticBias, options_->magnetic_bias_sd);
  set_three(covariance_, error::kAttitude, start.sd.tilt);
  set_three(covariance_, error::kVelocity, start.sd.velocity);
  set_three(covariance_, error::kPosition, start.sd.position);
  const auto set = [&](std::size_t i, double sd) { covariance_.restart(i, sd * sd); };
  set(error::kWind, start.sd.wind);
  set(error::kWind + 1, start.sd.wind);
  set(error::kBaroBias, options_->baro_bias_sd);
  set(error::kAirspeedScale, options_->airspeed_scale_sd);
  set(error::kAttitude + 2, start.sd.heading);
  set(error::kPosition + 2, start.sd.altitude);
  nav_.time = start.time;
  publish(Vec3::Zero());
}

void FlightEstimator::sense(const SensorSample& sample) {
  std::visit(
      [this](const auto& s) {
        if constexpr (requires { this->add(s); }) this->add(s);
      },
      sample);
}

void FlightEstimator::add(const ImuSample& sample) {
  if (direct_) return;
  if (!finite(sample.w_NB_B) || !finite(sample.f_B) || !std::isfinite(sample.interval)) {
    ++counts_.bad;
    return;
  }
  double dt = seconds_since(sample.time) * -1;
  if (dt <= 0) {
    ++counts_.late;
    return;
  }
  nav_.time = sample.time;
  if (aligning_) {
    align(sample, dt);
    return;
  }
  // 1 / (1 + k) = 1 - k + O(1e-5)
  const Vec3 w =
      (sample.w_NB_B - x_.gyro_bias).cwiseProduct(Vec3(Vec3::Ones() - x_.gyro_scale));
  const double gap = dt - sample.interval;
  if (gap > 0.5 * sample.interval && sample.interval > 0) {
    ++counts_.gaps;
    bridge(gap);
    if (gap > kHeldGap) dt = sample.interval;
  }
  strapdown(x_, step_, w, sample.f_B - x_.accel_bias, dt);
  if (alignment_) alignment_->add(w, sample.f_B - x_.accel_bias, dt);
  history_.remember(nav_.time, {x_.p_N, x_.v_N});
  publish(w);
  if (step_.dt > options_->period - 0.5 * dt) correct();
}

void FlightEstimator::replaced(FlightSensor sensor) {
  switch (sensor) {
    case FlightSensor::kImu:
      x_.gyro_bias.setZero();
      x_.accel_bias.setZero();
      x_.gyro_scale.setZero();
      set_three(covariance_, error::kGyroBias, options_->gyro_bias_sd);
      set_three(covariance_, error::kAccelBias, options_->accel_bias_sd);
      set_three(covariance_, error::kGyroScale, options_->gyro_scale_sd);
      return;
    case FlightSensor::kBarometer:
      x_.baro_bias = 0;
      altitude_.count = 0;
      covariance_.restart(error::kBaroBias,
                          options_->baro_bias_sd * options_->baro_bias_sd);
      return;
    case FlightSensor::kMagnetometer:
      x_.magnetic_bias.setZero();
      set_three(covariance_, error::kMagneticBias, options_->magnetic_bias_sd);
      return;
    case FlightSensor::kAirspeed:
      x_.airspeed_scale = 0;
      airspeed_.count = 0;
      covariance_.restart(error::kAirspeedScale,
                          options_->airspeed_scale_sd * options_->airspeed_scale_sd);
      return;
    case FlightSensor::kPower:
      return;
  }
}

// Across a long gap the motion goes straight on. What may have happened in it is noise.
void FlightEstimator::bridge(double gap) {
  alignment_.reset();
  if (gap > kLongGap) innovation_ratio_ = 2 * kDiverged;  // the attitude may be any
  if (gap > kHeldGap) {
    x_.p_N += gap * x_.v_N;
    history_.clear();
  }
  const double v_sd = kGapAcceleration * gap, turn_sd = kGapTurnRate * gap;
  for (std::size_t k = 0; k < 3; ++k) {
    covariance_.add(error::kAttitude + k, turn_sd * turn_sd);
    covariance_.add(error::kVelocity + k, v_sd * v_sd);
    covariance_.add(error::kPosition + k, 0.25 * v_sd * v_sd * gap * gap);
    covariance_.add(error::kPosition + k, error::kVelocity + k, 0.5 * v_sd * v_sd * gap);
  }
}

// Not for ever. While it aligns no fix has been accepted since the start.
bool FlightEstimator::waits_for_rest() const {
  return gnss_age() < kMaxRestWait;
}

// Whether it turns or is pushed by more than its sensors' errors.
bool FlightEstimator::is_shaken(const ImuSample& sample, double dt) const {
  const EstimatorOptions& o = *options_;
  const double per_root = 1 / std::sqrt(dt);
  const double turn = kShaken * math::hypot(o.gyro_bias_sd, o.gyro_noise * per_root);
  const double force =
      kShaken * math::hypot(o.accel_bias_sd + o.accel_scale_sd * kGravity,
                            o.accel_noise * per_root);
  return sample.w_NB_B.cwiseAbs().maxCoeff() > turn ||
         std::abs(sample.f_B.norm() - kGravity) > force;
}

// At rest gravity and biases are all that is felt. What a gust shakes has to come to rest
// again, unless that takes too long: then its tilt is known less well.
void FlightEstimator::align(const ImuSample& sample, double dt) {
  if (waits_for_rest() && is_shaken(sample, dt)) {
    align_w_.count = align_f_.count = align_m_.count = 0;
    align_from_ = nav_.time;
    return;
  }
  align_w_.add(dt * sample.w_NB_B);
  align_f_.add(dt * sample.f_B);
  if (seconds_since(align_from_) >= options_->alignment_time) finish_alignment();
}

void FlightEstimator::finish_alignment() {
  aligning_ = false;
  const Vec3 f = align_f_.sum;
  geo::Euler e{math::atan2(-f.y(), -f.z()), math::atan2(f.x(), math::hypot(f.y(), f.z())),
               geo::yaw(x_.q_NB)};
  const bool rested = waits_for_rest();
  set_three(covariance_, error::kAttitude, rested ? kRestTilt : kShakenTilt);
  if (align_m_.count > 0) {
    const Vec3 m = geo::from_euler({e.roll, e.pitch, 0}) * align_m_.sum;
    e.yaw = options_->declination - math::atan2(m.y(), m.x());
    // The first bearing brings it down, and ties it to the magnetometer's bias.
    covariance_.restart(error::kAttitude + 2, kUnknownHeading * kUnknownHeading);
  }
  x_.q_NB = geo::from_euler(e);
  // Gravity shows the tilt but for the accelerometers' bias b: theta x (-g) = R b.
  const Mat3 R = x_.q_NB.toRotationMatrix();
  const double bias = options_->accel_bias_sd / kGravity;
  for (std::size_t i = 0; i < 2; ++i) {
    covariance_.add(error::kAttitude + i, bias * bias);
    for (std::size_t j = 0; j < 3; ++j) {
      const double r = R(i == 0 ? 1 : 0, static_cast<Eigen::Index>(j));
      covariance_.add(error::kAttitude + i, error::kAccelBias + j,
                      (i == 0 ? 1 : -1) * bias * options_->accel_bias_sd * r);
    }
  }
  const double seconds = seconds_since(align_from_);
  if (rested) {
    x_.gyro_bias = align_w_.sum / seconds;
    set_three(covariance_, error::kGyroBias,
              math::hypot(options_->gyro_noise / std::sqrt(seconds), 1e-4));
  }
  publish(Vec3::Zero());
}

void FlightEstimator::add(const GnssFix& fix) {
  if (direct_ || aligning_) return;
  if (!finite(fix.p_N) || !finite(fix.v_N) ||
      !std::isfinite(fix.position_sd + fix.altitude_sd + fix.velocity_sd)) {
    ++counts_.bad;
    return;
  }
  if (has_fix_ && fix.time <= fix_.time) {
    ++counts_.late;
    return;
  }
  if (fix_waits_) correct();
  const MotionHistory::Motion present{x_.p_N, x_.v_N};
  if (fix.time > nav_.time) {
    at_fix_ = {x_.p_N - seconds_since(fix.time) * x_.v_N, x_.v_N};
  } else if (const auto then = history_.at(fix.time, nav_.time, present)) {
    at_fix_ = *then;
  } else {
    ++counts_.late;
    return;
  }
  take_precision_of(fix);
  fix_ = fix;
  has_fix_ = fix_waits_ = true;
}

void FlightEstimator::add(const BarometerSample& sample) {
  if (direct_ || aligning_) return;
  if (!std::isfinite(sample.altitude_msl)) {
    ++counts_.bad;
    return;
  }
  const double then = -x_.p_N.z() + x_.v_N.z() * seconds_since(sample.time);
  altitude_.add(sample.altitude_msl - then - x_.baro_bias);
}

void FlightEstimator::add(const MagnetometerSample& sample) {
  if (direct_) return;
  if (!finite(sample.m_B)) {
    ++counts_.bad;
    return;
  }
  if (aligning_) {
    align_m_.add(sample.m_B);
    return;
  }
  field_B_ = sample.m_B;
  field_time_ = sample.time;
  const double age = seconds_since(sample.time);
  field_N_.add(x_.q_NB * Vec3(sample.m_B - age * nav_.w_NB_B.cross(sample.m_B)));
}

void FlightEstimator::add(const AirspeedSample& sample) {
  if (direct_ || aligning_) return;
  if (!std::isfinite(sample.airspeed)) {
    ++counts_.bad;
    return;
  }
  const double ratio =
      sample.airspeed / (1 + x_.airspeed_scale) - (nav_.airspeed - airspeed_offset_);
  const double dt = (sample.time - airspeed_time_).seconds();
  const double share =
      has_airspeed_ && dt > 0 ? std::min(dt / (kAirspeedLag + dt), 1.0) : 1.0;
  airspeed_offset_ += share * (ratio - airspeed_offset_);
  has_airspeed_ = true;
  airspeed_time_ = sample.time;
  if (sample.airspeed > options_->min_airspeed)
    airspeed_.add((1 + x_.airspeed_scale) * ratio);
}

void FlightEstimator::add(const AnemometerSample& sample) {
  if (direct_ || aligning_) return;
  if (!finite(sample.v_AB_B)) {
    ++counts_.bad;
    return;
  }
  wind_N_.add(x_.v_N - x_.q_NB * sample.v_AB_B);
}

void FlightEstimator::add(const HeightSample& sample) {
  if (!std::isfinite(sample.height_agl)) {
    ++counts_.bad;
    return;
  }
  has_height_ = true;
  height_agl_ = sample.height_agl;
  height_time_ = sample.time;
}

void FlightEstimator::add(const TruthSample& sample) {
  if (!finite(sample.p_N) || !finite(sample.v_N) || !finite(sample.w_NB_B) ||
      !finite(sample.wind_N) || !std::isfinite(sample.q_NB.coeffs().sum())) {
    ++counts_.bad;
    return;
  }
  direct_ = true;
  aligning_ = false;
  nav_.time = accepted_fix_ = sample.time;
  x_.p_N = sample.p_N;
  x_.v_N = sample.v_N;
  x_.q_NB = sample.q_NB;
  x_.wind_N = sample.wind_N.head<2>();
  nav_ = {sample.time,
          sample.p_N,
          sample.v_N,
          sample.q_NB,
          sample.w_NB_B,
          sample.wind_N,
          (sample.v_N - sample.wind_N).norm()};
}

void FlightEstimator::publish(const Vec3& w_B) {
  nav_.p_N = x_.p_N;
  nav_.v_N = x_.v_N;
  nav_.q_NB = x_.q_NB;
  nav_.w_NB_B = w_B;
  nav_.wind_N = {x_.wind_N.x(), x_.wind_N.y(), 0};
  if (has_airspeed_ && seconds_since(airspeed_time_) > kStale) airspeed_offset_ = 0;
  nav_.airspeed = std::max((nav_.v_N - nav_.wind_N).norm() + airspeed_offset_, 0.0);
}

NavEstimate FlightEstimator::estimate() const {
  NavEstimate e;
  e.time = nav_.time;
  e.p_N = nav_.p_N;
  e.v_N = nav_.v_N;
  e.wind_N = nav_.wind_N.head<2>();
  const geo::Euler angles = geo::to_euler(nav_.q_NB);
  e.roll = angles.roll;
  e.pitch = angles.pitch;
  const Vec2 air = (nav_.v_N - nav_.wind_N).head<2>();
  e.heading = options_->fixed_wing && coordinated_ && air.norm() > options_->min_airspeed
                  ? geo::bearing(air)
                  : angles.yaw;
  const NavAccuracy accurate = accuracy();
  e.position_sd = accurate.position;
  e.altitude_sd = accurate.altitude;
  return e;
}

NavAccuracy FlightEstimator::accuracy() const {
  if (direct_) return {};
  const auto rms = [this](std::size_t at, std::size_t n) {
    double sum = 0;
    for (std::size_t k = 0; k < n; ++k) sum += covariance_.variance(at + k);
    return std::sqrt(sum / static_cast<double>(n));
  };
  return {rms(error::kPosition, 2),     rms(error::kPosition + 2, 1),
          rms(error::kVelocity, 3),     rms(error::kAttitude, 2),
          rms(error::kAttitude + 2, 1), rms(error::kWind, 2)};
}

double FlightEstimator::gnss_age() const {
  return seconds_since(accepted_fix_);
}

std::optional<double> FlightEstimator::height_agl() const {
  const double age = seconds_since(height_time_);
  if (!has_height_ || age > kStale) return std::nullopt;
  return height_agl_ - nav_.v_N.z() * age;
}

double FlightEstimator::gust_sd() const {
  return std::sqrt(std::max(gusts_along_.variance, 0.0));
}

}  // namespace skein::autopilot
