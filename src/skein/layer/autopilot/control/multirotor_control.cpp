// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/autopilot/control/multirotor_control.h"

#include <utility>

#include "skein/base/math.h"
#include "skein/data/vehicle/air.h"
#include "skein/layer/autopilot/control/bounded.h"
#include "skein/model/atmosphere/atmosphere.h"

namespace skein::autopilot {
namespace {

constexpr double kMaxPush = 6;           // of the horizontal integral [m/s^2]
constexpr double kMaxLift = 6;           // of the vertical integral [m/s^2]
constexpr double kMaxRateSum = 30;       // [rad/s^2]
constexpr double kAirborneShare = 0.4;   // of the weight
constexpr double kLearnsAbove = 0.8;     // cosine of the tilt
constexpr double kSinkMargin = 0.7;      // faster than demanded that costs no tilt [m/s]
constexpr double kTiltPerSink = 0.6;     // share of the tilt lost per speed beyond [s/m]
constexpr double kMinTilt = 0.2;         // share that is always left
constexpr double kIntegratesWithin = 1;  // speed errors beyond belong to a transit [m/s]
constexpr double kSameAir = 50;          // of altitude: density changes by 0.5 % [m]

bool motion_is_finite(const NavState& n) {
  return std::isfinite(n.p_N.sum() + n.v_N.sum() + n.q_NB.coeffs().sum() +
                       n.w_NB_B.sum());
}

bool is_finite(const MultirotorDemand& d) {
  return std::isfinite(d.position.sum() + d.velocity.sum() + d.acceleration.sum() +
                       d.altitude_msl + d.climb_rate + d.heading);
}

Vec2 shortened(const Vec2& v, double max) {
  const double length2 = v.squaredNorm();
  if (!(length2 > max * max)) return v;
  if (!std::isfinite(length2)) return Vec2::Zero();
  return v * (max / std::sqrt(length2));
}

Vec3 bounded_each(const Vec3& v, double max) {
  return {bounded(v.x(), max), bounded(v.y(), max), bounded(v.z(), max)};
}

}  // namespace

MultirotorControl::MultirotorControl(std::shared_ptr<const MultirotorSetup> setup)
    : setup_(std::move(setup)), mixer_(setup_->airframe, 0) {}

MultirotorControl::MultirotorControl(const MultirotorAirframe& airframe,
                                     const MultirotorGains& gains)
    : MultirotorControl(std::make_shared<const MultirotorSetup>(airframe, gains)) {}

void MultirotorControl::reset(const NavState& nav) {
  fresh_ = !motion_is_finite(nav);
  velocity_sum_.setZero();
  if (!fresh_) rates_ = bounded_each(nav.w_NB_B, 1e3);
}

void MultirotorControl::change(std::shared_ptr<const MultirotorSetup> setup) {
  setup_ = std::move(setup);
  mixer_ = Mixer(setup_->airframe, standing_);
}

void MultirotorControl::set_standing(std::uint8_t rotors) {
  if (rotors == standing_) return;
  standing_ = rotors;
  mixer_ = Mixer(setup_->airframe, standing_);
  rate_sum_.setZero();
  spins_ = !mixer_.holds_still();
}

Vec3 MultirotorControl::acceleration_for(const MultirotorDemand& demand,
                                         const NavState& nav, double dt) {
  const MultirotorGains& g = setup_->gains;
  const MultirotorAirframe& a = setup_->airframe;
  // Down first: what it takes is not there for the tilt.
  const double sink_demand =
      bounded(-demand.climb_rate - g.height_gain * (demand.altitude_msl + nav.p_N.z()),
              -a.climb_rate, a.sink_rate);
  const double sink_error = sink_demand - nav.v_N.z();
  const double down_setpoint = g.climb_gain * sink_error + velocity_sum_.z();
  const double down = bounded(down_setpoint, -g.acceleration_limit, g.acceleration_limit);
  if ((down_setpoint < g.acceleration_limit || sink_error < 0) &&
      (down_setpoint > -g.acceleration_limit || sink_error > 0))
    velocity_sum_.z() =
        bounded(velocity_sum_.z() + g.climb_integral * sink_error * dt, kMaxLift);

  Vec2 velocity = demand.velocity;
  if (demand.holds_position)
    velocity += g.position_gain * (demand.position - geo::horizontal(nav.p_N));
  const Vec2 error = shortened(velocity, a.fastest) - geo::horizontal(nav.v_N);
  const Vec2 sum = velocity_sum_.head<2>();
  const Vec2 setpoint = demand.acceleration + g.velocity_gain * error + sum;
  // Where the rotors cannot give both, height comes before place: against a strong wind
  // the tilt shrinks when the vehicle sinks although it shall not.
  const double spared =
      bounded(1 - kTiltPerSink * (-sink_error - kSinkMargin), kMinTilt, 1);
  const double max = spared * (kGravity - down) * setup_->tilt_tangent;
  const Vec2 across = shortened(setpoint, max);
  // Frozen where the tilt is at its limit, and in transit to a far point.
  const bool full = setpoint.squaredNorm() > max * max && setpoint.dot(error) > 0;
  if (!full && error.squaredNorm() < kIntegratesWithin * kIntegratesWithin)
    velocity_sum_.head<2>() = shortened(sum + g.velocity_integral * error * dt, kMaxPush);
  return {across.x(), across.y(), down};
}

// Thrust at sea level that makes one unit of thrust up here: the rotors' is known there.
double MultirotorControl::thin_air(double altitude_msl) {
  if (!(std::abs(altitude_msl - air_altitude_) < kSameAir)) {
    air_altitude_ = altitude_msl;
    thin_air_ = model::kSeaLevelDensity / model::standard_air(altitude_msl).density;
  }
  return thin_air_;
}

// Turn rates that bring the rotors' axis to a direction given in the body.
Vec3 MultirotorControl::tilt_rates(const Vec3& up_B) const {
  const double cosine = -up_B.z();
  // 2 sin(e/2) along the axis: the vector part of the shortest rotation, twice.
  const double half = std::sqrt(std::max(0.0, (1 + cosine) / 2));
  Vec3 rates = half > 0.02 ? Vec3(up_B.y(), -up_B.x(), 0) / half : Vec3(2, 0, 0);
  rates *= setup_->gains.tilt_gain;
  const double max = setup_->gains.tilt_rate_limit;
  const double length2 = rates.squaredNorm();
  return length2 > max * max ? Vec3(rates * (max / std::sqrt(length2))) : rates;
}

// Where the rotors cannot follow, integrals may only shrink.
void MultirotorControl::integrate_rates(const std::array<bool, 3>& limited,
                                        const Vec3& step) {
  for (int k = 0; k < 3; ++k) {
    const bool grows = step[k] * rate_sum_[k] > 0;
    if (!grows || !limited[static_cast<std::size_t>(k)])
      rate_sum_[k] = bounded(rate_sum_[k] + step[k], kMaxRateSum);
  }
}

Actuators MultirotorControl::turn(const Vec3& rates, double thrust, const NavState& nav,
                                  double dt) {
  const MultirotorGains& g = setup_->gains;
  const Vec3& inertia = setup_->airframe.inertia;
  const Vec3& w = nav.w_NB_B;
  const Vec3 gain(g.rate_gain, g.rate_gain, g.yaw_rate_gain);
  const Vec3 error = rates - w;
  const double share = bounded(g.derivative_filter * dt, 0, 1);
  const Vec3 slope = bounded_each((w - rates_) * g.derivative_filter, 1e4);
  rates_ = bounded_each(rates_ + share * (w - rates_), 1e4);
  Vec3 angular = gain.cwiseProduct(error) + rate_sum_;
  angular.head<2>() -= g.rate_derivative * g.rate_gain * slope.head<2>();
  Vec3 torque = inertia.cwiseProduct(angular) + w.cross(inertia.cwiseProduct(w));
  if (spins_) {
    // What holds in N turns backwards in the body while the rotors make it.
    const double late = 1 / g.rate_gain + setup_->motor_lag / 2;
    const double angle = bounded(-w.z() * late, geo::kPi / 2);
    const double c = math::cos(angle), s = math::sin(angle);
    torque.head<2>() =
        Vec2(c * torque.x() - s * torque.y(), s * torque.x() + c * torque.y());
  }
  torque *= thin_air(-nav.p_N.z());
  const Mix mix = mixer_.mix({thrust, torque});
  const bool airborne = thrust > kAirborneShare * setup_->airframe.mass * kGravity;
  if (airborne && !spins_) {
    integrate_rates({mix.tilt_limited, mix.tilt_limited, mix.yaw_limited},
                    g.rate_integral * dt * gain.cwiseProduct(gain).cwiseProduct(error));
  }
  return last_ = mix.throttle;
}

Actuators MultirotorControl::control(const MultirotorDemand& demand, const NavState& nav,
                                     double dt) {
  if (!(dt > 0) || !motion_is_finite(nav) || !is_finite(demand)) return last_;
  if (fresh_) reset(nav);
  if (demand.phase == FlightPhase::kGround) {
    velocity_sum_.setZero();
    rate_sum_.setZero();
    rates_.setZero();
    return last_ = {};
  }
  const MultirotorGains& g = setup_->gains;
  const Vec3 down_B = geo::down_in_body(nav.q_NB);
  const double cos_tilt = down_B.z();
  const Vec3 f_N = acceleration_for(demand, nav, dt) - Vec3(0, 0, kGravity);
  const double length = std::max(f_N.norm(), 0.1);
  const Vec3 up_B = nav.q_NB.conjugate() * (f_N / length);

  // The share of the thrust that already points where it shall.
  const double thrust = setup_->airframe.mass * thin_air(-nav.p_N.z()) * hover_scale_ *
                        length * bounded(-up_B.z(), 0.2, 1);
  if (cos_tilt > kLearnsAbove) {
    const double moved = g.hover_learning * dt * velocity_sum_.z();
    const double scale = bounded(hover_scale_ * (1 - moved / kGravity), setup_->min_scale,
                                 setup_->max_scale);
    if (scale != hover_scale_) velocity_sum_.z() -= moved;
    hover_scale_ = scale;
  }

  Vec3 rates = tilt_rates(up_B);
  if (spins_) {
    rates.z() = nav.w_NB_B.z();
    return turn(rates, thrust, nav, dt);
  }
  // Heading error e as 2 sin(e/2), from the forward axis over the ground.
  const Quat& q = nav.q_NB;
  const double north = q.w() * q.w() + q.x() * q.x() - q.y() * q.y() - q.z() * q.z();
  const double east = 2 * (q.x() * q.y() + q.w() * q.z());
  const double cos_d = math::cos(demand.heading), sin_d = math::sin(demand.heading);
  const double over_ground = std::sqrt(north * north + east * east);
  const double cosine = (north * cos_d + east * sin_d) / std::max(over_ground, 1e-3);
  const double sine = north * sin_d - east * cos_d;
  const double heading_error =
      std::copysign(std::sqrt(std::max(0.0, 2 * (1 - cosine))), sine);
  const double yaw_rate =
      bounded(g.heading_gain * heading_error, g.yaw_rate_limit) * bounded(cos_tilt, 0, 1);
  rates += yaw_rate * down_B;
  return turn(rates, thrust, nav, dt);
}

Actuators MultirotorControl::stabilize(const AttitudeDemand& demand, const NavState& nav,
                                       double dt) {
  if (!(dt > 0) || !motion_is_finite(nav)) return last_;
  velocity_sum_.setZero();
  const MultirotorGains& g = setup_->gains;
  const double limit = setup_->airframe.tilt_limit;
  const double roll = bounded(demand.roll, limit), pitch = bounded(demand.pitch, limit);
  // The rotors' axis as commanded, in axes turned by the present heading only; then in
  // the body.
  const Vec3 setpoint(-math::sin(pitch) * math::cos(roll), math::sin(roll),
                      -math::cos(pitch) * math::cos(roll));
  const Quat level = geo::from_euler({0, 0, geo::yaw(nav.q_NB)});
  const Vec3 up_B = nav.q_NB.conjugate() * (level * setpoint);
  const double yaw_rate = bounded(demand.yaw_rate, g.manual_yaw_rate);
  return turn(tilt_rates(up_B) + yaw_rate * geo::down_in_body(nav.q_NB),
              bounded(demand.throttle, 0, 1) * setup_->max_thrust, nav, dt);
}

Actuators MultirotorControl::manual(const PilotInput& sticks, const NavState& nav,
                                    double dt) {
  if (!(dt > 0) || !motion_is_finite(nav)) return last_;
  velocity_sum_.setZero();
  const MultirotorGains& g = setup_->gains;
  const Vec3 rates(bounded(sticks.roll, 1) * g.manual_tilt_rate,
                   bounded(sticks.pitch, 1) * g.manual_tilt_rate,
                   bounded(sticks.yaw, 1) * g.manual_yaw_rate);
  return turn(rates, bounded(sticks.throttle, 0, 1) * setup_->max_thrust, nav, dt);
}

AttitudeDemand MultirotorControl::attitude_for(const PilotInput& sticks) const {
  const double limit = setup_->airframe.tilt_limit;
  return {bounded(sticks.roll, 1) * limit, bounded(sticks.pitch, 1) * limit,
          bounded(sticks.yaw, 1) * setup_->gains.manual_yaw_rate,
          bounded(sticks.throttle, 0, 1)};
}

}  // namespace skein::autopilot
