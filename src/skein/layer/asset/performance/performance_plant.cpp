// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/asset/performance/performance_plant.h"

#include <algorithm>
#include <cmath>

#include "skein/base/check.h"
#include "skein/base/math.h"
#include "skein/layer/asset/body/bounded.h"

namespace skein::asset {
namespace {

constexpr double kLongestStep = 0.1;     // of the integration [s]
constexpr double kFullClimb = 1;         // climb rate from which all power is used [m/s]
constexpr double kSteepest = 1.4;        // bank that the equations still cover [rad]
constexpr double kSpanEfficiency = 0.8;  // Oswald's e of light aeroplanes
constexpr int kAirspeeds = 20;           // looked at for a ceiling

EnergySource source_of(const PerformanceParameters& p) {
  if (p.electric) return Battery(p.battery);
  return FuelTank(p.tank);
}

// What is left of two demands of one sign when they may take `max` together.
double cut(double max, double first, double second) {
  const double both = first + second;
  if (both <= max) return 1;
  return max > 0 ? max / both : 0;
}

}  // namespace

// What moves.
struct PerformancePlant::Point {
  Vec2 distance;  // through the air [m]
  double height, heading, airspeed;
};

struct PerformancePlant::Rate {
  Vec2 distance;
  double climb, turn, acceleration;
  double thrust;  // that this takes [N]
};

// What stays as it is during a step.
struct PerformancePlant::Phase {
  double airspeed, climb;  // commanded, within limits [m/s]
  double mass, density;
  double max_power, min_power;  // at the shaft [W]
};

PerformancePlant::PerformancePlant(const PerformanceParameters& parameters)
    : parameters_(parameters), model_(parameters), source_(source_of(parameters)) {
  SKEIN_CHECK(number_errors(parameters).empty());
}

FlightLimits PerformancePlant::limits() const {
  const PerformanceParameters& p = parameters_;
  const double mass = model_.mass(1), weight = mass * kGravity;
  const double drag = model_.drag(p.cruise, weight, kSeaLevel);
  const double climb = (model_.thrust(p.power, p.cruise) - drag) * p.cruise / weight;
  const double sink =
      (drag - model_.thrust(p.idle_power * p.power, p.cruise)) * p.cruise / weight;
  const double bank = steepest_bank(p.cruise, mass, kSeaLevel);
  return {p.cruise,
          p.cruise * p.cruise / (kGravity * math::tan(bank)),
          std::clamp(climb, 0.0, p.climb_rate),
          p.slowest,
          p.fastest,
          std::min(p.sink_rate, sink),
          min_density(),
          kClimbAcceleration};
}

// K = 1 / (pi e b^2 / S): the induced drag gives the span.
Airframe PerformancePlant::airframe() const {
  const PerformanceParameters& p = parameters_;
  if (p.induced_drag <= 0) return SelfStabilised{};
  return SelfStabilised{
      std::sqrt(p.wing_area / (geo::kPi * kSpanEfficiency * p.induced_drag))};
}

// The thinnest air, with full tank, in which the cruise power holds some airspeed that
// the wing can be flown at.
double PerformancePlant::min_density() const {
  const PerformanceParameters& p = parameters_;
  const double mass = model_.mass(1);
  const auto flies = [&](double density) {
    const double min =
        std::max(p.slowest, p.stall_reserve * model_.stall_speed(mass, density));
    for (int i = 0; i <= kAirspeeds; ++i) {
      const double v = min + (p.fastest - min) * i / kAirspeeds;
      if (v > p.fastest) return false;
      const double power = p.cruise_power * model_.max_power(density);
      if (model_.thrust(power, v) >= model_.drag(v, mass * kGravity, density))
        return true;
    }
    return false;
  };
  double low = 0, high = kSeaLevel;
  for (int i = 0; i < 20; ++i) {
    const double middle = (low + high) / 2;
    (flies(middle) ? high : low) = middle;
  }
  return high;
}

// The bank that the airspeed carries with its reserve; a little even when it is too slow.
double PerformancePlant::steepest_bank(double airspeed, double mass,
                                       double density) const {
  const double min = parameters_.stall_reserve * model_.stall_speed(mass, density);
  const double margin = min / airspeed;
  return std::min(parameters_.bank_limit, math::acos(std::min(0.999, margin * margin)));
}

VehicleState PerformancePlant::start(const VehicleStart& start) const {
  const PerformanceParameters& p = parameters_;
  VehicleState state;
  state.p_N = start.p_N;
  state.airspeed = p.cruise;
  state.q_NB = geo::from_euler({0, 0, start.heading});
  state.v_N = start.wind_N;
  state.v_N.head<2>() += p.cruise * geo::unit(start.heading);
  const double drag = model_.drag(p.cruise, model_.mass(1) * kGravity, kSeaLevel);
  const double power = model_.power(drag, p.cruise);
  state.actuators[channel::kThrottle] = power / p.power;
  draw(source_, state.energy, {}, p.electric ? power / p.motor_efficiency : power, 0);
  return state;
}

PerformancePlant::Phase PerformancePlant::phase_of(const VehicleState& state, double roll,
                                                   const FlightCommand& command,
                                                   const Air& air) const {
  const PerformanceParameters& p = parameters_;
  Phase phase;
  phase.mass = model_.mass(state.energy.charge);
  phase.density = air.density;
  // In a bank the wings carry 1 / cos(roll) of the weight.
  const double min = p.stall_reserve * model_.stall_speed(phase.mass, air.density) /
                     std::sqrt(math::cos(roll));
  phase.airspeed = bounded_or(p.cruise, command.airspeed,
                              std::min(std::max(p.slowest, min), p.fastest), p.fastest);
  phase.climb = bounded_or(0, command.climb_rate, -p.sink_rate, p.climb_rate);
  const double climbing = std::clamp(phase.climb / kFullClimb, 0.0, 1.0);
  const double rating = p.cruise_power + (1 - p.cruise_power) * climbing;
  phase.max_power = rating * model_.max_power(air.density);
  phase.min_power = std::min(p.idle_power * p.power, phase.max_power);
  if (state.faults.is_dead(channel::kThrottle))
    phase.max_power = phase.min_power = 0;
  else if (state.faults.is_stuck(channel::kThrottle))
    phase.max_power = phase.min_power = state.actuators[channel::kThrottle] * p.power;
  return phase;
}

PerformancePlant::Rate PerformancePlant::rate(const Point& point, double roll,
                                              const Phase& phase) const {
  const PerformanceParameters& p = parameters_;
  const double v = point.airspeed, weight = phase.mass * kGravity;
  const double drag = model_.drag(v, weight / math::cos(roll), phase.density);
  // Everything as climb rates [m/s]: what is available, and what is commanded.
  const double max = (model_.thrust(phase.max_power, v) - drag) * v / weight;
  const double min = (model_.thrust(phase.min_power, v) - drag) * v / weight;
  const double acceleration_setpoint =
      std::clamp((phase.airspeed - v) / p.airspeed_lag, -p.acceleration, p.acceleration);
  const double speed_up = v * acceleration_setpoint / kGravity;
  const double up = std::max(phase.climb, 0.0), down = std::min(phase.climb, 0.0);
  const double faster = std::max(speed_up, 0.0), slower = std::min(speed_up, 0.0);

  double climb = phase.climb, change = speed_up;
  if (climb + change > max) {
    const double part = cut(max - down - slower, up, faster);
    climb = down + part * up;
    change = slower + part * faster;
    if (climb + change > max) climb = max - change;
  } else if (climb + change < min) {
    const double part = cut(up + faster - min, -down, -slower);
    climb = up + part * down;
    change = faster + part * slower;
    if (climb + change < min) climb = min - change;
  }
  climb = std::clamp(climb, -v, v);

  Rate rate;
  rate.distance = std::sqrt(v * v - climb * climb) * geo::unit(point.heading);
  rate.climb = climb;
  rate.turn = kGravity * math::tan(roll) / v;
  rate.acceleration = change * kGravity / v;
  rate.thrust = drag + weight * (climb + change) / v;
  return rate;
}

PerformancePlant::Point PerformancePlant::short_step(const Point& point,
                                                     const Phase& phase, double roll,
                                                     double roll_rate, double dt) const {
  const auto moved = [](Point from, const Rate& k, double time) {
    from.distance += time * k.distance;
    from.height += time * k.climb;
    from.heading += time * k.turn;
    from.airspeed += time * k.acceleration;
    return from;
  };
  const double middle = roll + roll_rate * dt / 2;
  const Rate k1 = rate(point, roll, phase);
  const Rate k2 = rate(moved(point, k1, dt / 2), middle, phase);
  const Rate k3 = rate(moved(point, k2, dt / 2), middle, phase);
  const Rate k4 = rate(moved(point, k3, dt), roll + roll_rate * dt, phase);
  Rate mean;
  mean.distance = (k1.distance + 2 * (k2.distance + k3.distance) + k4.distance) / 6;
  mean.climb = (k1.climb + 2 * (k2.climb + k3.climb) + k4.climb) / 6;
  mean.turn = (k1.turn + 2 * (k2.turn + k3.turn) + k4.turn) / 6;
  mean.acceleration =
      (k1.acceleration + 2 * (k2.acceleration + k3.acceleration) + k4.acceleration) / 6;
  return moved(point, mean, dt);
}

void PerformancePlant::step(VehicleState& state, const Control& control, const Air& air,
                            double dt) const {
  const PerformanceParameters& p = parameters_;
  const FlightCommand& command = std::get<FlightCommand>(control);
  const geo::Euler attitude = geo::to_euler(state.q_NB);
  Point point{Vec2::Zero(), 0, attitude.yaw, state.airspeed};
  double roll = std::clamp(attitude.roll, -kSteepest, kSteepest);

  const double steepest =
      steepest_bank(state.airspeed, model_.mass(state.energy.charge), air.density);
  double roll_setpoint = bounded_or(0, command.roll, -steepest, steepest);
  if (state.faults.is_dead(channel::kAileron) || state.faults.is_stuck(channel::kAileron))
    roll_setpoint = roll;

  Phase phase = phase_of(state, roll_setpoint, command, air);
  const double shaft =
      std::clamp(model_.power(rate(point, roll, phase).thrust, point.airspeed),
                 phase.min_power, phase.max_power);
  const double taken = p.electric ? shaft / p.motor_efficiency : shaft;
  const double share = draw(source_, state.energy, state.faults, taken, dt);
  if (share < 1) {
    phase.max_power = std::min(phase.max_power, share * shaft);
    phase.min_power = std::min(phase.min_power, phase.max_power);
  }
  state.actuators[channel::kThrottle] = share * shaft / p.power;

  // Until the roll arrives it changes evenly, then it stays: cut there, so that each part
  // is smooth.
  double left = dt;
  while (left > 0) {
    double part = std::min(left, kLongestStep);
    const double missing = roll_setpoint - roll;
    double roll_rate = 0;
    if (missing != 0) {
      const double arrival = std::abs(missing) / p.roll_rate;
      if (arrival < 1e-12) {
        roll = roll_setpoint;
        continue;
      }
      part = std::min(part, arrival);
      roll_rate = std::copysign(p.roll_rate, missing);
    }
    point = short_step(point, phase, roll, roll_rate, part);
    roll += roll_rate * part;
    left = left - part > 1e-12 ? left - part : 0;
  }

  const Rate last = rate(point, roll, phase);
  const double heading = geo::wrap_pi(point.heading);
  const Quat before = state.q_NB;
  state.p_N += dt * air.wind_N;
  state.p_N += Vec3(point.distance.x(), point.distance.y(), -point.height);
  state.v_N = air.wind_N + Vec3(last.distance.x(), last.distance.y(), -last.climb);
  state.airspeed = point.airspeed;
  state.q_NB = geo::from_euler({roll, math::asin(last.climb / point.airspeed), heading});
  if (dt > 0) state.w_NB_B = geo::log_so3(before.conjugate() * state.q_NB) / dt;
}

}  // namespace skein::asset
