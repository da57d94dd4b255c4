// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/asset/kinematic_plant.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "skein/base/check.h"
#include "skein/base/math.h"
#include "skein/layer/asset/body/bounded.h"

namespace skein::asset {
namespace {

constexpr double kLongestStep = 0.1;  // of the quadrature [s]
constexpr double kNoTime = 1e-15;     // no rate can be computed over less [s]

}  // namespace

KinematicPlant::KinematicPlant(const KinematicOptions& options)
    : options_(options),
      roll_limit_(math::atan(options.airspeed * options.airspeed /
                             (kGravity * options.turn_radius))) {
  SKEIN_CHECK(options.airspeed > 0 && options.turn_radius > 0 && options.power >= 0 &&
              options.capacity_Wh >= 0);
}

// What moves, as the equations name it.
struct KinematicPlant::Point {
  Vec3 p_N, v_N;
  double airspeed, roll, pitch, heading;
};

FlightLimits KinematicPlant::limits() const {
  return {options_.airspeed,
          options_.turn_radius,
          options_.climb_rate,
          options_.slowest(),
          options_.airspeed * (1 + options_.airspeed_range),
          options_.climb_rate};
}

VehicleState KinematicPlant::start(const VehicleStart& start) const {
  VehicleState state;
  state.p_N = start.p_N;
  state.airspeed = options_.airspeed;
  state.q_NB = geo::from_euler({0, 0, start.heading});
  state.v_N = start.wind_N;
  state.v_N.head<2>() += options_.airspeed * geo::unit(start.heading);
  state.v_N.z() = 0;
  return state;
}

// Whether there was any.
bool KinematicPlant::draw_power(VehicleState& state, double dt) const {
  Energy& energy = state.energy;
  if (state.faults.battery || state.faults.is_dead(channel::kThrottle) ||
      energy.charge <= 0) {
    energy.power = 0;
    return false;
  }
  energy.power = options_.power;
  if (options_.capacity_Wh > 0)
    energy.charge = std::max(
        0.0, energy.charge - options_.power * dt / (3600 * options_.capacity_Wh));
  return true;
}

void KinematicPlant::step(VehicleState& state, const Control& control, const Air& air,
                          double dt) const {
  const FlightCommand& command = std::get<FlightCommand>(control);
  FlightCommand bounded;
  bounded.roll = bounded_or(0, command.roll, -roll_limit_, roll_limit_);
  bounded.airspeed = bounded_or(options_.airspeed, command.airspeed, options_.slowest(),
                                options_.airspeed * (1 + options_.airspeed_range));
  bounded.climb_rate =
      bounded_or(0, command.climb_rate, -options_.climb_rate, options_.climb_rate);
  if (!draw_power(state, dt))
    bounded.climb_rate = std::min(bounded.climb_rate, -options_.glide_sink);

  const geo::Euler attitude = geo::to_euler(state.q_NB);
  Point next{state.p_N,     state.v_N,      state.airspeed,
             attitude.roll, attitude.pitch, attitude.yaw};
  if (options_.roll_rate <= 0) next.roll = bounded.roll;
  if (options_.airspeed_lag <= 0) next.airspeed = bounded.airspeed;
  // Until the roll arrives it changes evenly, then it stays: cut there, so that each part
  // is smooth.
  double left = dt;
  while (left > 0) {
    double part = std::min(left, kLongestStep);
    const double missing = std::abs(bounded.roll - next.roll);
    if (missing > 0 && missing < options_.roll_rate * part) {
      part = missing / options_.roll_rate;
      if (part < kNoTime) {
        next.roll = bounded.roll;
        continue;
      }
    }
    short_step(next, bounded, air, part);
    left = left - part > 1e-12 ? left - part : 0;
  }
  const Quat before = state.q_NB;
  state.p_N = next.p_N;
  state.v_N = next.v_N;
  state.airspeed = next.airspeed;
  state.q_NB = geo::from_euler({next.roll, next.pitch, next.heading});
  if (dt > 0) state.w_NB_B = geo::log_so3(before.conjugate() * state.q_NB) / dt;
}

void KinematicPlant::short_step(Point& point, const FlightCommand& command,
                                const Air& air, double dt) const {
  const double roll_missing = command.roll - point.roll;
  const double roll_step = std::min(std::abs(roll_missing), options_.roll_rate * dt);
  const double roll_rate = std::copysign(roll_step / dt, roll_missing);
  const double slow = point.airspeed - command.airspeed;
  const auto airspeed_at = [&](double t) {
    return slow == 0 ? command.airspeed
                     : command.airspeed + slow * math::exp(-t / options_.airspeed_lag);
  };

  // Airspeed and turn rate at five even times, for two half steps of Simpson's rule.
  std::array<double, 5> airspeed{}, turn_rate{};
  double last_roll = 0, sideways = 0;  // most of the time it does not roll
  for (std::size_t i = 0; i < 5; ++i) {
    const double t = dt * static_cast<double>(i) / 4;
    airspeed[i] = airspeed_at(t);
    const double roll = point.roll + roll_rate * t;
    if (i == 0 || roll != last_roll) {
      last_roll = roll;
      sideways = kGravity * math::tan(roll);
    }
    turn_rate[i] = sideways / airspeed[i];
  }
  const double half_turn = dt / 12 * (turn_rate[0] + 4 * turn_rate[1] + turn_rate[2]);
  const double turn =
      half_turn + dt / 12 * (turn_rate[2] + 4 * turn_rate[3] + turn_rate[4]);

  const double steepest = std::min(airspeed[0], airspeed[4]);
  const double climb = std::clamp(command.climb_rate, -steepest, steepest);
  const auto velocity = [&](double v, double heading) -> Vec2 {
    const double level = std::sqrt(std::max(0.0, v * v - climb * climb));
    return level * geo::unit(heading);
  };
  const Vec2 middle = velocity(airspeed[2], point.heading + half_turn);
  const Vec2 last = velocity(airspeed[4], point.heading + turn);
  const Vec2 moved = dt / 6 * (velocity(airspeed[0], point.heading) + 4 * middle + last);

  point.p_N += dt * air.wind_N;
  point.p_N.head<2>() += moved;
  point.p_N.z() -= dt * climb;
  point.v_N = air.wind_N;
  point.v_N.head<2>() += last;
  point.v_N.z() -= climb;
  point.airspeed = airspeed[4];
  point.roll =
      roll_step == std::abs(roll_missing) ? command.roll : point.roll + roll_rate * dt;
  point.pitch = math::asin(climb / airspeed[4]);
  point.heading = geo::wrap_pi(point.heading + turn);
}

}  // namespace skein::asset
