// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <deque>

#include "skein/base/random.h"
#include "skein/data/vehicle/air.h"
#include "skein/data/vehicle/sensing.h"
#include "skein/layer/autopilot/estimator/error_state.h"
#include "skein/layer/autopilot/estimator/flight_estimator.h"

namespace skein::autopilot::testing {

/// A first-order Gauss-Markov number in its steady state.
class Wander {
 public:
  Wander(double sd, double tau, double dt, FastNormals& normal)
      : sd_(sd), phi_(std::exp(-dt / tau)), x_(sd * normal()) {}
  double value() const { return x_; }
  double step(FastNormals& normal) {
    x_ = phi_ * x_ + sd_ * std::sqrt(1 - phi_ * phi_) * normal();
    return x_;
  }

 private:
  double sd_, phi_, x_;
};

/// Where and how the synthetic aircraft flies.
struct FlightPlan {
  bool manoeuvres = true;  ///< turns, climbs, speed changes; else straight and level
  Vec2 wind = Vec2::Zero();
  double gust_sd = 0;  ///< per axis of the path, correlated over 200 m [m/s]
  double outage_from = 1e9, outage_until = 1e9;  ///< of the fixes [s]
  bool barometer = true, magnetometer = true, airspeed = true;
};

/// A fixed wing in coordinated flight with all its sensors, made for estimators: the
/// motion is prescribed, so attitude, rates and forces are exact, and every error is
/// drawn from the models that EstimatorOptions assumes, or finer ones.
///
/// Air velocity V u(course, climb angle); ground velocity adds the wind and the gusts
/// that the aircraft has yielded to (lag 2 s). Angle of attack 0.05 rad, side-slip
/// wanders with 0.01 rad.
class SyntheticFlight {
 public:
  static constexpr double kDt = 0.01;

  SyntheticFlight(const EstimatorOptions& options, const FlightPlan& plan,
                  std::uint64_t seed)
      : options_(options),
        plan_(plan),
        normal_(RandomStream(seed, 1, Purpose::kTest)),
        slip_(0.01, 4, kDt, normal_),
        gust_along_(plan.gust_sd, 10, kDt, normal_),
        gust_across_(plan.gust_sd, 10, kDt, normal_),
        multipath_{wander3(options.gnss_multipath_sd, options.gnss_multipath_time)},
        receiver_{wander3(options.gnss_noise_sd, options.gnss_noise_time)},
        baro_drift_(1, 600, kBaroStep * kDt, normal_) {
    for (std::size_t k = 0; k < 3; ++k) {
      // Sources of the slow error: clock, orbit, ionosphere.
      const double scale = k < 2 ? 0.636 : 1.4;
      slow_[3 * k] = Wander(scale * 2, 1800, kFixStep * kDt, normal_);
      slow_[3 * k + 1] = Wander(scale * 2.5, 3600, kFixStep * kDt, normal_);
      slow_[3 * k + 2] = Wander(scale * 5, 1800, kFixStep * kDt, normal_);
    }
    const auto three = [&](double sd) {
      const double x = normal_(), y = normal_(), z = normal_();
      return Vec3(sd * Vec3(x, y, z));
    };
    truth_.gyro_bias = three(options.gyro_bias_sd);
    truth_.accel_bias = accel_bias_ = three(options.accel_bias_sd);
    truth_.magnetic_bias = three(options.magnetic_bias_sd);
    truth_.gyro_scale = three(options.gyro_scale_sd);
    accel_scale_ = three(options.accel_scale_sd);
    truth_.airspeed_scale = options.airspeed_scale_sd * normal_();
    truth_.wind_N = plan.wind;
    baro_constant_ = normal_();
    course_ = geo::kPi * normal_();
    phase_ = 20 * std::abs(normal_());
    truth_.p_N = {0, 0, -200};
    move();
    truth_.p_N = {0, 0, -200};
  }

  const Navigated& truth() const { return truth_; }
  Time now() const { return now_; }
  double true_airspeed() const { return airspeed_; }

  /// A start around the truth, as wrong as it says.
  EstimatorStart start(const NavAccuracy& sd) {
    EstimatorStart s;
    s.time = now_;
    s.sd = sd;
    const auto draw = [&](double d) { return d * normal_(); };
    ErrorVector e{};
    for (std::size_t k = 0; k < 2; ++k) {
      e[error::kPosition + k] = draw(sd.position);
      e[error::kAttitude + k] = draw(sd.tilt);
      e[error::kWind + k] = draw(sd.wind);
    }
    for (std::size_t k = 0; k < 3; ++k) e[error::kVelocity + k] = draw(sd.velocity);
    e[error::kPosition + 2] = draw(sd.altitude);
    e[error::kAttitude + 2] = draw(sd.heading);
    const Navigated x = corrected(truth_, e);
    s.p_N = x.p_N;
    s.v_N = x.v_N;
    s.q_NB = x.q_NB;
    s.wind_N = x.wind_N;
    return s;
  }

  /// Flies one step of 0.01 s and gives `take` what the sensors say.
  template <class Take>
  void step(Take&& take) {
    const Quat q = truth_.q_NB;
    const Vec3 v = truth_.v_N;
    now_ += Time::from_ns(10'000'000);
    ++tick_;
    move();
    take(imu(q, v));
    if (tick_ % kFixStep == 0) fixes_.push_back(fix());
    if (!fixes_.empty() && fixes_.front().time + kLatency <= now_) {
      const double t = fixes_.front().time.seconds();
      if (t < plan_.outage_from || t >= plan_.outage_until) take(fixes_.front());
      fixes_.pop_front();
    }
    if (tick_ % kBaroStep != 0) return;
    truth_.baro_bias = baro_constant_ + baro_drift_.step(normal_);
    if (plan_.barometer)
      take(BarometerSample{
          now_, -truth_.p_N.z() + truth_.baro_bias + options_.baro_noise * normal_()});
    const Vec3 field(std::cos(1.15), 0, std::sin(1.15));
    if (plan_.magnetometer)
      take(MagnetometerSample{now_, truth_.q_NB.conjugate() * field +
                                        truth_.magnetic_bias +
                                        options_.magnetic_noise * normal3()});
    if (plan_.airspeed)
      take(AirspeedSample{now_, (1 + truth_.airspeed_scale) * airspeed_ +
                                    options_.airspeed_noise * normal_()});
  }

 private:
  static constexpr std::int64_t kFixStep = 20, kBaroStep = 4;
  static constexpr Time kLatency = Time::from_ns(120'000'000);

  Vec3 normal3() {
    const double x = normal_(), y = normal_(), z = normal_();
    return {x, y, z};
  }

  std::array<Wander, 3> wander3(double sd, double tau) {
    const double down = 1.4 / 0.636, dt = kFixStep * kDt;
    return {Wander(sd, tau, dt, normal_), Wander(sd, tau, dt, normal_),
            Wander(down * sd, tau, dt, normal_)};
  }

  // One step of the prescribed flight.
  void move() {
    const double t = now_.seconds() + phase_;
    double bank = 0, climb = 0, speed = 20;
    if (plan_.manoeuvres) {
      const double in_lap = std::fmod(t, 120);
      if (in_lap > 15 && in_lap < 30) bank = 0.5;
      if (in_lap > 45 && in_lap < 60) climb = 0.15;
      if (in_lap > 65 && in_lap < 85) bank = -0.7;
      if (in_lap > 85 && in_lap < 100) climb = -0.15;
      if (in_lap > 100) speed = 24;
    }
    bank_ += kDt / 0.5 * (bank - bank_);
    smooth_bank_ += kDt / 0.3 * (bank_ - smooth_bank_);
    climb_ += kDt / 2 * (climb - climb_);
    speed_ += kDt / 3 * (speed - speed_);
    course_ += kDt * kGravity * std::tan(smooth_bank_) / speed_;

    const Quat path = geo::from_euler({smooth_bank_, climb_, course_});
    const Vec3 along = path * Vec3(1, 0, 0);
    const Vec3 across(-std::sin(course_), std::cos(course_), 0);
    const Vec3 gust =
        gust_along_.step(normal_) * along + gust_across_.step(normal_) * across;
    gust_speed_ += kDt / 2 * (gust - gust_speed_);
    const double north = normal_(), east = normal_();
    truth_.wind_N += options_.wind_walk * std::sqrt(kDt) * Vec2(north, east);
    const Vec3 wind(truth_.wind_N.x(), truth_.wind_N.y(), 0);
    const Vec3 v = speed_ * along + wind + gust_speed_;
    truth_.p_N += 0.5 * kDt * (truth_.v_N + v);
    truth_.v_N = v;
    airspeed_ = (v - wind - gust).norm();
    const double slip = slip_.step(normal_);
    truth_.q_NB = path * geo::from_euler({0, 0.05, 0}) * geo::from_euler({0, 0, -slip});
    truth_.gyro_bias += options_.gyro_bias_walk * std::sqrt(kDt) * normal3();
    accel_bias_ += options_.accel_bias_walk * std::sqrt(kDt) * normal3();
  }

  // The estimator's bias is what the accelerometers show too much in lasting flight.
  void count_scale_as_bias(const Vec3& f) {
    usual_f_ += kDt / 3 * (f - usual_f_);
    truth_.accel_bias = accel_bias_ + accel_scale_.cwiseProduct(usual_f_);
  }

  ImuSample imu(const Quat& q, const Vec3& v) {
    const Vec3 turn = geo::log_so3(q.conjugate() * truth_.q_NB);
    const Vec3 w = turn / kDt;
    const Quat q_mid = q * geo::exp_so3(0.5 * turn);
    const Vec3 f =
        q_mid.conjugate() * Vec3((truth_.v_N - v) / kDt - Vec3(0, 0, kGravity));
    const double per_root = 1 / std::sqrt(kDt);
    count_scale_as_bias(f + Vec3(0, 0, kGravity));
    return {now_, kDt,
            w + truth_.gyro_scale.cwiseProduct(w) + truth_.gyro_bias +
                options_.gyro_noise * per_root * normal3(),
            f + accel_scale_.cwiseProduct(f + Vec3(0, 0, kGravity)) + accel_bias_ +
                options_.accel_noise * per_root * normal3()};
  }

  GnssFix fix() {
    Vec3 fast;
    for (int k = 0; k < 3; ++k) {
      const auto i = static_cast<std::size_t>(k);
      truth_.gnss_bias[k] = slow_[3 * i].step(normal_) + slow_[3 * i + 1].step(normal_) +
                            slow_[3 * i + 2].step(normal_);
      fast[k] = multipath_[i].step(normal_) + receiver_[i].step(normal_);
    }
    const double sd = std::sqrt(0.636 * 0.636 * (4 + 6.25 + 25) +
                                std::pow(options_.gnss_multipath_sd, 2) +
                                std::pow(options_.gnss_noise_sd, 2));
    return {now_,
            truth_.p_N + truth_.gnss_bias + fast,
            truth_.v_N + 0.05 * normal3(),
            sd,
            sd * 1.4 / 0.636,
            0.05,
            GnssKind::kSingle};
  }

  EstimatorOptions options_;
  FlightPlan plan_;
  FastNormals normal_;
  Navigated truth_;
  Wander slip_, gust_along_, gust_across_;
  std::array<Wander, 3> multipath_, receiver_;
  Wander baro_drift_;
  std::array<Wander, 9> slow_{none(), none(), none(), none(), none(),
                              none(), none(), none(), none()};
  Wander none() { return Wander(0, 1, 1, normal_); }
  Vec3 accel_bias_, usual_f_ = Vec3::Zero(), accel_scale_, gust_speed_ = Vec3::Zero();
  double baro_constant_ = 0, course_ = 0, phase_ = 0, airspeed_ = 0;
  double bank_ = 0, smooth_bank_ = 0, climb_ = 0, speed_ = 20;
  std::deque<GnssFix> fixes_;
  Time now_;
  std::int64_t tick_ = 0;
};

/// Normalised estimation error squared of some states, in order.
inline double nees(const Navigated& truth, const FlightEstimator& estimator,
                   std::size_t first, std::size_t last) {
  const ErrorVector e = difference(truth, estimator.navigated());
  const auto n = static_cast<Eigen::Index>(last - first);
  Eigen::MatrixXd p(n, n);
  Eigen::VectorXd x(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    x[i] = e[first + static_cast<std::size_t>(i)];
    for (Eigen::Index j = 0; j < n; ++j)
      p(i, j) = estimator.covariance()(first + static_cast<std::size_t>(i),
                                       first + static_cast<std::size_t>(j));
  }
  return x.dot(p.llt().solve(x));
}

}  // namespace skein::autopilot::testing
