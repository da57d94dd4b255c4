// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/asset/multirotor/multirotor_plant.h"

#include <algorithm>
#include <cmath>

#include "skein/base/check.h"
#include "skein/base/math.h"
#include "skein/layer/asset/multirotor/momentum.h"

namespace skein::asset {
namespace {

// A rotor below this stands [rad/s]; so no step works with numbers near underflow.
constexpr double kStands = 1e-6;
// The rotors must give this many times what hovering takes: to climb, and to correct.
constexpr double kHoverReserve = 1.1;

// Level, thrust along `up` instead of straight up, forward axis towards `heading`.
Quat attitude_of(const Vec3& up_N, double heading) {
  const Vec3 down = -up_N;
  const Vec3 across(-math::sin(heading), math::cos(heading), 0);
  const Vec3 forward = across.cross(down).normalized();
  Mat3 R_NB;
  R_NB << forward, down.cross(forward), down;
  return Quat(R_NB);
}

}  // namespace

MultirotorPlant::MultirotorPlant(const MultirotorParameters& parameters)
    : parameters_(parameters),
      body_(parameters.mass, parameters.inertia),
      rotors_(parameters.rotors),
      battery_(parameters.battery),
      disc_area_(disc_area(parameters)),
      profile_factor_(profile_torque_factor(parameters)) {
  SKEIN_CHECK(number_errors(parameters).empty());
}

FlightLimits MultirotorPlant::limits() const {
  const MultirotorParameters& p = parameters_;
  // What tilt is left for turning when drag at cruise has taken its part.
  const Vec3 thrust_down = geo::down_in_body(trim({p.cruise, 0, 0}, 0).q_NB);
  const double against_drag = kGravity * std::abs(thrust_down.x()) / thrust_down.z();
  const double max = kGravity * math::tan(p.tilt_limit);
  const double turning =
      std::sqrt(std::max(max * max - against_drag * against_drag, 1e-4 * max * max));
  // Thrust is in proportion to the density.
  const auto hover =
      rotors_.thrusts(p.mass * kGravity, Vec3::Zero(), p.torque_factor / p.thrust_factor);
  const double loaded = *std::max_element(
      hover.begin(), hover.begin() + static_cast<std::ptrdiff_t>(rotors_.size()));
  const double full_thrust = p.thrust_factor * p.fastest_rotor * p.fastest_rotor;
  return {p.cruise,
          p.cruise * p.cruise / turning,
          p.climb_rate,
          0,
          p.fastest,
          p.sink_rate,
          kHoverReserve * loaded / full_thrust * kRotorDensity,
          kClimbAcceleration};
}

Airframe MultirotorPlant::airframe() const {
  const MultirotorParameters& p = parameters_;
  MultirotorAirframe a;
  a.mass = p.mass;
  a.inertia = {p.inertia.xx, p.inertia.yy, p.inertia.zz};
  a.rotors = p.rotors;
  a.thrust_max = p.thrust_factor * p.fastest_rotor * p.fastest_rotor;
  a.torque_ratio = p.torque_factor / p.thrust_factor;
  a.thrust_exponent = 2;
  a.tilt_limit = p.tilt_limit;
  a.cruise = p.cruise;
  a.fastest = p.fastest;
  a.climb_rate = p.climb_rate;
  a.sink_rate = p.sink_rate;
  a.motor_lag = p.motor_lag;
  for (const RotorPlace& rotor : p.rotors)
    a.diameter = std::max(a.diameter, 2 * (rotor.position.norm() + p.rotor_radius));
  return a;
}

VehicleState MultirotorPlant::start(const VehicleStart& start) const {
  VehicleState state;
  state.p_N = start.p_N;
  state.airspeed = start.wind_N.norm();
  state.energy.voltage = battery_.open_circuit(state.energy.charge);
  state.on_ground = start.on_ground;
  if (start.on_ground) {
    state.q_NB = geo::from_euler({0, parameters_.ground.rest_pitch, start.heading});
    return state;
  }
  const MultirotorTrim hover = trim(-start.wind_N, start.heading);
  state.q_NB = hover.q_NB;
  state.actuators = hover.rotors;
  battery_.draw(state.energy, {}, hover.power, 0);
  return state;
}

MultirotorTrim MultirotorPlant::trim(const Vec3& v_AB_N, double heading,
                                     double density) const {
  const MultirotorParameters& p = parameters_;
  const double thrust_factor = p.thrust_factor * density / kRotorDensity;
  const double weight = p.mass * kGravity;
  MultirotorTrim trim;
  trim.q_NB = geo::from_euler({0, 0, heading});
  std::fill_n(trim.rotors.begin(), rotors_.size(),
              std::sqrt(weight / thrust_factor / static_cast<double>(rotors_.size())));
  // Drag depends little on attitude and rotor speeds, so this converges fast.
  for (int i = 0; i < 100; ++i) {
    const MultirotorTrim last = trim;
    const Mat3 R_NB = rotation(trim.q_NB);
    const Loads held = drag(rotors_.sums(trim.rotors),
                            {R_NB.transpose() * v_AB_N, Vec3::Zero(), density});
    const Vec3 thrust_N = -(R_NB * held.force_B + Vec3(0, 0, weight));
    const auto thrusts = rotors_.thrusts(thrust_N.norm(), -held.moment_B,
                                         p.torque_factor / p.thrust_factor);
    trim.q_NB = attitude_of(thrust_N.normalized(), heading);
    double change = geo::log_so3(trim.q_NB * last.q_NB.conjugate()).norm();
    for (std::size_t k = 0; k < rotors_.size(); ++k) {
      trim.rotors[k] = std::clamp(std::sqrt(std::max(0.0, thrusts[k]) / thrust_factor),
                                  0.0, p.fastest_rotor);
      change = std::max(change, std::abs(trim.rotors[k] - last.rotors[k]));
    }
    if (change < 1e-10) break;
  }
  trim.power =
      power(rotors_.sums(trim.rotors), rotation(trim.q_NB).transpose() * v_AB_N, density);
  return trim;
}

double MultirotorPlant::power(const RotorSums& rotors, const Vec3& v_AB_B,
                              double density) const {
  const MultirotorParameters& p = parameters_;
  const double sigma = density / kRotorDensity;
  const double climb = -v_AB_B.z();
  const double along2 = v_AB_B.head<2>().squaredNorm();
  const double thrust =
      sigma * (p.thrust_factor * rotors.ww - p.axial_drag * climb * rotors.w);
  double shaft =
      sigma * profile_factor_ *
      (rotors.www + 4.65 * along2 / (p.rotor_radius * p.rotor_radius) * rotors.w);
  if (thrust > 0) {
    const double induced =
        induced_speed(thrust / (2 * density * disc_area_), along2, climb);
    shaft += thrust * (p.induced_factor * induced + climb);
  }
  return std::max(0.0, shaft) / p.efficiency + p.standing_power;
}

Loads MultirotorPlant::drag(const RotorSums& s, const Flow& flow) const {
  const MultirotorParameters& p = parameters_;
  const double sigma = flow.density / kRotorDensity;
  const Vec3& v = flow.v_B;
  const Vec3& w = flow.w_B;
  const double d = sigma * p.rotor_drag, a = sigma * p.axial_drag;
  Loads loads;
  loads.force_B = {-d * (s.w * v.x() - w.z() * s.wy), -d * (s.w * v.y() + w.z() * s.wx),
                   -a * (s.w * v.z() + w.x() * s.wy - w.y() * s.wx)};
  loads.moment_B = {-a * (s.wy * v.z() + w.x() * s.wyy - w.y() * s.wxy),
                    a * (s.wx * v.z() + w.x() * s.wxy - w.y() * s.wxx),
                    -d * (s.wx * v.y() - s.wy * v.x() + w.z() * (s.wxx + s.wyy))};
  loads.force_B -=
      (0.5 * flow.density * std::sqrt(v.squaredNorm())) * p.drag_area.cwiseProduct(v);
  loads.moment_B -= (sigma * p.turn_drag * std::sqrt(w.squaredNorm())) * w;
  return loads;
}

Loads MultirotorPlant::loads(const RotorSums& s, double spin_rate, const Flow& flow,
                             const Vec3& w_NB_B) const {
  const MultirotorParameters& p = parameters_;
  const double k = p.thrust_factor * flow.density / kRotorDensity;
  const double c = p.torque_factor * flow.density / kRotorDensity;
  const double spun = p.rotor_inertia * s.sw;
  Loads loads = drag(s, flow);
  loads.force_B.z() -= k * s.ww;
  loads.moment_B += Vec3(w_NB_B.y() * spun - k * s.wwy, k * s.wwx - w_NB_B.x() * spun,
                         c * s.sww + p.rotor_inertia * spin_rate);
  return loads;
}

RotorSpeeds MultirotorPlant::targets(const VehicleState& state,
                                     const Actuators& throttles, double share) const {
  // Power goes with the third power of the speed.
  const double part = share < 1 ? math::cbrt(share) : 1;
  RotorSpeeds targets{};
  for (std::size_t k = 0; k < rotors_.size(); ++k) {
    const double speed = state.actuators[k];
    const double throttle =
        throttles[k] > 0 ? std::min(throttles[k], 1.0) : 0;  // not a number: 0
    targets[k] = throttle * parameters_.fastest_rotor;
    if (share < 1) targets[k] = std::min(targets[k], part * speed);
    if (state.faults.is_stuck(k)) targets[k] = speed;
    if (state.faults.is_dead(k)) targets[k] = 0;
  }
  return targets;
}

void MultirotorPlant::step(VehicleState& state, const Control& control, const Air& air,
                           double dt) const {
  const Actuators& throttles = std::get<Actuators>(control);
  const MultirotorParameters& p = parameters_;
  RotorSpeeds& speeds = state.actuators;

  RotorSums sums[3];  // at the step's beginning, middle and end
  sums[0] = rotors_.sums(speeds);
  const Vec3 v_B = rotation(state.q_NB).transpose() * (state.v_N - air.wind_N);
  const double share =
      battery_.draw(state.energy, state.faults, power(sums[0], v_B, air.density), dt);

  const RotorSpeeds target = targets(state, throttles, share);
  const double half_decay = math::exp(-0.5 * dt / p.motor_lag);
  for (int half = 1; half <= 2; ++half) {
    for (std::size_t k = 0; k < rotors_.size(); ++k)
      speeds[k] = target[k] + (speeds[k] - target[k]) * half_decay;
    sums[half] = rotors_.sums(speeds);
  }
  const double target_sw = rotors_.sums(target).sw;
  for (std::size_t k = 0; k < rotors_.size(); ++k)
    if (target[k] == 0 && speeds[k] < kStands) speeds[k] = 0;

  Motion motion = motion_of(state);
  rk4_step(body_, motion, dt, [&](const Stage& stage) {
    const Motion& m = stage.motion;
    const RotorSums& s = sums[stage.halves];
    const Flow flow{stage.R_NB.transpose() * (m.v_N - air.wind_N), m.w_NB_B - air.rates_B,
                    air.density};
    return loads(s, (target_sw - s.sw) / p.motor_lag, flow, m.w_NB_B);
  });
  set_motion(state, motion);
  state.airspeed = std::sqrt((state.v_N - air.wind_N).squaredNorm());
  state.on_ground = false;  // touch() says otherwise
}

Contact MultirotorPlant::touch(VehicleState& state, double ground_msl, double dt) const {
  return touch_ground(parameters_.ground, state, ground_msl, dt);
}

}  // namespace skein::asset
