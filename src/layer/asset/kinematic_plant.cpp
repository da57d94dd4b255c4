#include "layer/asset/kinematic_plant.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/check.h"

namespace skein::asset {
namespace {

constexpr double kGravity = 9.80665;  // [m/s^2]
constexpr double kLongestStep = 0.1;  // of the quadrature [s]
constexpr double kNoTime = 1e-15;     // no rate can be told over less [s]

// `value` within [low, high]; `otherwise` when it is not a number.
double bounded_or(double otherwise, double value, double low, double high) {
  return std::isnan(value) ? otherwise : std::clamp(value, low, high);
}

}  // namespace

KinematicPlant::KinematicPlant(const KinematicOptions& options)
    : options_(options),
      roll_limit_(std::atan(options.airspeed * options.airspeed /
                            (kGravity * options.turn_radius))) {
  SKEIN_CHECK(options.airspeed > 0 && options.turn_radius > 0);
}

FlightLimits KinematicPlant::limits() const {
  return {options_.airspeed, options_.turn_radius, options_.climb_rate};
}

VehicleState KinematicPlant::step(const VehicleState& state, const FlightCommand& command,
                                  const Air& air, double dt) const {
  FlightCommand bounded;
  bounded.roll = bounded_or(0, command.roll, -roll_limit_, roll_limit_);
  bounded.airspeed = bounded_or(options_.airspeed, command.airspeed, options_.slowest(),
                                options_.airspeed * (1 + options_.airspeed_range));
  bounded.climb_rate =
      bounded_or(0, command.climb_rate, -options_.climb_rate, options_.climb_rate);

  VehicleState next = state;
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
    next = short_step(next, bounded, air, part);
    left = left - part > 1e-12 ? left - part : 0;
  }
  return next;
}

VehicleState KinematicPlant::short_step(const VehicleState& state,
                                        const FlightCommand& command, const Air& air,
                                        double dt) const {
  const double roll_missing = command.roll - state.roll;
  const double roll_step = std::min(std::abs(roll_missing), options_.roll_rate * dt);
  const double roll_rate = std::copysign(roll_step / dt, roll_missing);
  const double slow = state.airspeed - command.airspeed;
  const auto airspeed_at = [&](double t) {
    return slow == 0 ? command.airspeed
                     : command.airspeed + slow * std::exp(-t / options_.airspeed_lag);
  };

  // Airspeed and turn rate at five even times, for two half steps of Simpson's rule.
  std::array<double, 5> airspeed{}, turn_rate{};
  for (std::size_t i = 0; i < 5; ++i) {
    const double t = dt * static_cast<double>(i) / 4;
    airspeed[i] = airspeed_at(t);
    turn_rate[i] = kGravity * std::tan(state.roll + roll_rate * t) / airspeed[i];
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
  const Vec2 middle = velocity(airspeed[2], state.heading + half_turn);
  const Vec2 last = velocity(airspeed[4], state.heading + turn);
  const Vec2 moved = dt / 6 * (velocity(airspeed[0], state.heading) + 4 * middle + last);

  VehicleState next;
  next.p_N = state.p_N + dt * air.wind_N;
  next.p_N.head<2>() += moved;
  next.p_N.z() -= dt * climb;
  next.v_N = air.wind_N;
  next.v_N.head<2>() += last;
  next.v_N.z() -= climb;
  next.airspeed = airspeed[4];
  next.roll =
      roll_step == std::abs(roll_missing) ? command.roll : state.roll + roll_rate * dt;
  next.pitch = std::asin(climb / airspeed[4]);
  next.heading = geo::wrap_pi(state.heading + turn);
  return next;
}

}  // namespace skein::asset
