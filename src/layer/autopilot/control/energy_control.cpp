#include "layer/autopilot/control/energy_control.h"

#include <algorithm>
#include <cmath>

#include "data/air.h"
#include "layer/autopilot/control/bounded.h"

namespace skein::autopilot {
namespace {

constexpr double kFilterDamping = 0.9;
constexpr double kFlareGain =
    0.8;  // path angle per error of the sink rate, times airspeed
constexpr double kSlowMargin = 0.1;  // of the least airspeed, over which weights change
constexpr double kOverspeedMargin = 0.05;
constexpr double kMostPathSum = 0.3;  // [rad]
constexpr double kMostThrottleSum = 0.8;

// How much pitch serves height and airspeed.
struct Weights {
  double height = 1, airspeed = 1;
};

// Throttle that holds a specific power above level flight at cruise.
double throttle_for(const FixedWingSetup& setup, double power) {
  return setup.airframe.trim_throttle + setup.throttle_slope * power;
}

// Angle of attack that carries the load factor at this airspeed, up to that at the least
// airspeed.
double angle_of_attack(const FixedWingSetup& setup, double load, double speed) {
  const FixedWingAirframe& a = setup.airframe;
  const double lift = std::min(load * (a.cruise * a.cruise) / (speed * speed),
                               1.1 * (a.cruise * a.cruise) / (a.slowest * a.slowest));
  return a.trim_alpha + setup.alpha_per_load * (lift - 1);
}

Weights weights(FlightPhase phase, double speed, double slowest,
                const FixedWingAirframe& a) {
  const bool fixed_throttle =
      phase == FlightPhase::kGlide || phase == FlightPhase::kClimbOut || !a.motor;
  if (fixed_throttle) return {0, 1};
  const double slow = (slowest - speed) / (kSlowMargin * slowest);
  const double fast = (speed - a.fastest) / (kOverspeedMargin * a.fastest);
  return {1 - bounded(std::max(slow, fast), 0, 1), 1};
}

}  // namespace

void EnergyControl::reset(const EnergyView& view, double pitch, double throttle) {
  *this = EnergyControl{};
  gust_ = view.airspeed - view.calm_airspeed;
  speed_ = view.airspeed;
  pitch_ = pitch;
  throttle_ = throttle;
}

void EnergyControl::follow(const FixedWingSetup& setup, const EnergyView& view,
                           double pitch, double throttle, double dt) {
  filter(setup.gains, view, dt);
  pitch_ = pitch;
  throttle_ = throttle;
  fresh_ = true;
}

void EnergyControl::filter(const FixedWingGains& g, const EnergyView& view, double dt) {
  const double gust = view.airspeed - view.calm_airspeed;
  gust_ = bounded(gust_ + bounded(g.gust_filter * dt, 0, 1) * (gust - gust_), 1e3);
  const double w = g.airspeed_filter;
  const double innovation = view.calm_airspeed + gust_ - speed_;
  acceleration_ = bounded(acceleration_ + w * w * innovation * dt, 3 * kGravity);
  speed_ = bounded(speed_ + (acceleration_ + 2 * kFilterDamping * w * innovation) * dt, 0,
                   1e3);
}

EnergyOutput EnergyControl::step(const FixedWingSetup& setup,
                                 const FixedWingDemand& demand, const EnergyView& view,
                                 double dt) {
  const FixedWingGains& g = setup.gains;
  const FixedWingAirframe& a = setup.airframe;
  filter(g, view, dt);
  const double speed = std::max(speed_, 0.5 * a.slowest);
  const double to_power = speed / kGravity;  // acceleration to specific power

  // Lift grows with the square of airspeed, so the least airspeed with the load's root.
  const double slowest = a.slowest * std::sqrt(view.load);
  const Weights weight = weights(demand.phase, speed_, slowest, a);
  const double speed_demand =
      bounded(demand.airspeed, std::min(slowest, a.fastest), a.fastest);
  // By throttle what the motor can give; by pitch what a path angle of 10 degrees gives.
  const double by_pitch = (1 - weight.height) * 0.17 * kGravity;
  const double acceleration_demand =
      bounded(g.airspeed_gain * (speed_demand - speed_),
              -std::max(by_pitch, 0.5 * a.sink_rate / to_power),
              std::max(by_pitch, 0.5 * a.climb_rate / to_power));
  const double climb_demand = bounded(
      demand.climb_rate + g.height_gain * (demand.altitude_msl - view.altitude_msl),
      -a.sink_rate, a.climb_rate);

  const double kinetic = to_power * acceleration_;
  const double energy = view.climb_rate + kinetic;
  const double energy_demand =
      bounded(climb_demand + to_power * acceleration_demand, -a.sink_rate, a.climb_rate);
  const double turn_power =
      g.turn_drag * a.sink_rate * (view.load * view.load - 1) * a.cruise / speed;
  const double balance_demand =
      weight.height * climb_demand - weight.airspeed * to_power * acceleration_demand;
  const double balance = weight.height * view.climb_rate - weight.airspeed * kinetic;
  const double alpha = angle_of_attack(setup, view.load, speed);
  const double carried = (1 - weight.height) * energy;
  if (fresh_) {
    // So that going on as now would leave pitch and throttle where they are.
    path_sum_ = (pitch_ - alpha) * speed - carried - balance;
    throttle_sum_ = throttle_ - throttle_for(setup, energy + turn_power);
    fresh_ = false;
  }

  const double energy_error = energy_demand - energy;
  const double throttle_wanted =
      throttle_for(setup, energy_demand + turn_power) +
      setup.throttle_slope * g.energy_rate_gain * energy_error + throttle_sum_;
  double throttle_aim = bounded(throttle_wanted, 0, 1);
  const bool fixed = demand.phase == FlightPhase::kGlide ||
                     demand.phase == FlightPhase::kClimbOut ||
                     demand.phase == FlightPhase::kFlare || !a.motor;
  if (fixed) {
    throttle_aim = demand.phase == FlightPhase::kClimbOut && a.motor ? 1 : 0;
  } else if (weight.height < 1 && speed_ < slowest) {
    throttle_aim += (1 - weight.height) * (1 - throttle_aim);
  } else if ((throttle_wanted < 1 || energy_error < 0) &&
             (throttle_wanted > 0 || energy_error > 0)) {
    throttle_sum_ = bounded(
        throttle_sum_ + setup.throttle_slope * g.energy_integral * energy_error * dt,
        kMostThrottleSum);
  }
  throttle_ = bounded(throttle_aim, throttle_ - g.throttle_rate * dt,
                      throttle_ + g.throttle_rate * dt);

  double path;  // path angle times airspeed [m/s]
  if (demand.phase == FlightPhase::kFlare) {
    path = demand.climb_rate + (demand.climb_rate - view.climb_rate) * kFlareGain;
  } else {
    path = carried + balance_demand + g.balance_gain * (balance_demand - balance) +
           path_sum_;
  }
  const double lowest =
      demand.phase == FlightPhase::kClimbOut || demand.phase == FlightPhase::kFlare
          ? std::min(a.trim_alpha, 0.0)
          : a.pitch_down;
  const double pitch_wanted = alpha + path / speed;
  const double pitch_aim = bounded(pitch_wanted, lowest, a.pitch_up);
  const double most = g.vertical_acceleration / speed * dt;
  pitch_ = bounded(pitch_aim, pitch_ - most, pitch_ + most);
  const double balance_error = balance_demand - balance;
  if ((pitch_wanted < a.pitch_up || balance_error < 0) &&
      (pitch_wanted > lowest || balance_error > 0) && demand.phase != FlightPhase::kFlare)
    path_sum_ = bounded(path_sum_ + g.balance_integral * balance_error * dt,
                        kMostPathSum * speed);
  return {pitch_, throttle_};
}

}  // namespace skein::autopilot
