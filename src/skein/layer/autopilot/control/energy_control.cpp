// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/autopilot/control/energy_control.h"

#include <algorithm>
#include <cmath>

#include "skein/data/vehicle/air.h"
#include "skein/layer/autopilot/control/bounded.h"

namespace skein::autopilot {
namespace {

constexpr double kFilterDamping = 0.9;
constexpr double kFlareGain = 1.5;   // path angle times airspeed per sink rate error
constexpr double kFlareDive = 0.12;  // pitch down, still with motor [rad]
constexpr double kSoftSink = 0.2;    // of a touch-down with level nose [m/s]
constexpr double kClimbShare = 0.5;  // of the power, at least, climbing after take-off
// Pitch begins to serve airspeed below so many times the minimum airspeed,
constexpr double kSlowFrom = 1.03;
constexpr double kSlowMargin = 0.15;  // and this much below serves nothing else
constexpr double kSteepPath = 0.17;   // [rad]
constexpr double kOverspeedMargin = 0.05;
constexpr double kMaxPathSum = 0.3;  // [rad]
constexpr double kMaxThrottleSum = 0.8;

// Throttle that holds a specific power above level flight at cruise.
double throttle_for(const FixedWingSetup& setup, double power) {
  return setup.airframe.trim_throttle + setup.throttle_slope * power;
}

// Angle of attack that carries the load factor at this airspeed.
// `reserve`: maximum lift, over the weight at the minimum airspeed.
double angle_of_attack(const FixedWingSetup& setup, double load, double speed,
                       double reserve) {
  const FixedWingAirframe& a = setup.airframe;
  const double lift = std::min(load * (a.cruise * a.cruise) / (speed * speed),
                               reserve * (a.cruise * a.cruise) / (a.slowest * a.slowest));
  return a.trim_alpha + setup.alpha_per_load * (lift - 1);
}

// How far the airspeed is too low for the height to count, from 0 to 1.
double slowness(double speed, double slowest) {
  return bounded((kSlowFrom * slowest - speed) / (kSlowMargin * slowest), 0, 1);
}

// The same for too fast.
double fastness(double speed, double fastest) {
  return bounded((speed - fastest) / (kOverspeedMargin * fastest), 0, 1);
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
  filter(setup, view, dt);
  pitch_ = pitch;
  throttle_ = throttle;
  fresh_ = true;
}

void EnergyControl::filter(const FixedWingSetup& setup, const EnergyView& view,
                           double dt) {
  const double gust = view.airspeed - view.calm_airspeed;
  gust_ = bounded(gust_ + bounded(setup.gust_bandwidth * dt, 0, 1) * (gust - gust_), 1e3);
  const double w = setup.gains.airspeed_filter;
  const double innovation = view.calm_airspeed + gust_ - speed_;
  acceleration_ = bounded(acceleration_ + w * w * innovation * dt, 3 * kGravity);
  speed_ = bounded(speed_ + (acceleration_ + 2 * kFilterDamping * w * innovation) * dt, 0,
                   1e3);
}

EnergyControl::Rates EnergyControl::rates(const FixedWingSetup& setup,
                                          const FixedWingDemand& demand,
                                          const EnergyView& view, double speed) const {
  const FixedWingGains& g = setup.gains;
  const FixedWingAirframe& a = setup.airframe;
  // Lift grows with the square of airspeed, so the minimum airspeed with the load's root.
  const double slowest = std::min(a.slowest * std::sqrt(view.load), a.fastest);
  Rates r;
  r.too_slow = slowness(speed_, slowest);
  const bool thrust_given = !a.motor || demand.phase == FlightPhase::kGlide ||
                            demand.phase == FlightPhase::kClimbOut;
  r.height_weight =
      thrust_given ? 0 : 1 - std::max(r.too_slow, fastness(speed_, a.fastest));
  const double speed_demand = bounded(demand.airspeed, slowest, a.fastest);
  const double to_power = speed / kGravity;  // acceleration to specific power
  // By throttle what the motor can give; by pitch what a path angle of 10 degrees gives.
  const double by_pitch = (1 - r.height_weight) * kSteepPath * kGravity;
  double kinetic_demand =
      to_power * bounded(g.airspeed_gain * (speed_demand - speed_),
                         -std::max(by_pitch, 0.5 * a.sink_rate / to_power),
                         std::max(by_pitch, 0.5 * a.climb_rate / to_power));
  const double climb_demand = bounded(
      demand.climb_rate + g.height_gain * (demand.altitude_msl - view.altitude_msl),
      -a.sink_rate, a.climb_rate);
  const double kinetic = to_power * acceleration_;
  r.energy = view.climb_rate + kinetic;
  if (demand.phase == FlightPhase::kClimbOut)
    kinetic_demand =
        std::min(kinetic_demand, (1 - kClimbShare) * std::max(r.energy, 0.0));
  r.energy_demand = bounded(climb_demand + kinetic_demand, -a.sink_rate, a.climb_rate);
  r.balance = r.height_weight * view.climb_rate - kinetic;
  r.balance_demand = r.height_weight * climb_demand - kinetic_demand;
  r.turn_power =
      g.turn_drag * a.sink_rate * (view.load * view.load - 1) * a.cruise / speed;
  return r;
}

void EnergyControl::move_throttle(const FixedWingSetup& setup,
                                  const FixedWingDemand& demand, const Rates& r,
                                  double dt) {
  const FlightPhase phase = demand.phase;
  const bool idle_flare = phase == FlightPhase::kFlare && demand.airspeed <= 0;
  const FixedWingGains& g = setup.gains;
  const FixedWingAirframe& a = setup.airframe;
  const double error = r.energy_demand - r.energy;
  const double setpoint = throttle_for(setup, r.energy_demand + r.turn_power) +
                          setup.throttle_slope * g.energy_rate_gain * error +
                          throttle_sum_;
  double aim = bounded(setpoint, 0, 1);
  if (!a.motor || phase == FlightPhase::kGlide || idle_flare) {
    aim = 0;
  } else if (phase == FlightPhase::kClimbOut) {
    aim = 1;
  } else {
    aim += r.too_slow * (1 - aim);
    // Too slow, it grows only: an engine weaker than the airframe's file says is found
    // out there as well, or it would stay there.
    const bool may_fall = setpoint > 0 && r.too_slow <= 0;
    if ((setpoint < 1 || error < 0) && (may_fall || error > 0))
      throttle_sum_ =
          bounded(throttle_sum_ + setup.throttle_slope * g.energy_integral * error * dt,
                  kMaxThrottleSum);
  }
  const double max = g.throttle_rate * dt;
  throttle_ = bounded(bounded(aim, throttle_ - max, throttle_ + max), 0, 1);
}

void EnergyControl::move_pitch(const FixedWingSetup& setup, const FixedWingDemand& demand,
                               const EnergyView& view, const Rates& r, double alpha,
                               double speed, double dt) {
  const FixedWingGains& g = setup.gains;
  const FixedWingAirframe& a = setup.airframe;
  const bool flare = demand.phase == FlightPhase::kFlare;
  const double error = r.balance_demand - r.balance;
  const double path =  // path angle times airspeed [m/s]
      flare ? demand.climb_rate + kFlareGain * (demand.climb_rate - view.climb_rate)
            : r.carried() + r.balance_demand + g.balance_gain * error + path_sum_;
  double lowest = a.pitch_down;
  if (flare) lowest = std::min(a.trim_alpha, 0.0);
  // Just off the ground no height is given for airspeed.
  if (demand.phase == FlightPhase::kClimbOut) lowest = std::min(alpha, a.pitch_up);
  // The nose may be down for a sink that is asked for, but not any more at the touch.
  if (flare) lowest += std::min(demand.climb_rate + kSoftSink, 0.0) / speed;
  if (flare && demand.airspeed > 0) lowest -= kFlareDive;
  const double setpoint = alpha + path / speed;
  const double max = g.vertical_acceleration / speed * dt;
  pitch_ = bounded(bounded(setpoint, lowest, a.pitch_up), pitch_ - max, pitch_ + max);
  if (!flare && (setpoint < a.pitch_up || error < 0) && (setpoint > lowest || error > 0))
    path_sum_ = bounded(path_sum_ + g.balance_integral * error * dt, kMaxPathSum * speed);
}

EnergyOutput EnergyControl::step(const FixedWingSetup& setup,
                                 const FixedWingDemand& demand, const EnergyView& view,
                                 double dt) {
  const FixedWingGains& g = setup.gains;
  filter(setup, view, dt);
  const bool flare = demand.phase == FlightPhase::kFlare;

  const double speed = std::max(speed_, 0.5 * setup.airframe.slowest);
  const Rates r = rates(setup, demand, view, speed);
  const double alpha =
      angle_of_attack(setup, view.load, speed, flare ? g.flare_reserve : g.lift_reserve);
  if (fresh_) {
    // So that going on as now would leave pitch and throttle where they are.
    path_sum_ = (pitch_ - alpha) * speed - r.carried() - r.balance;
    throttle_sum_ = throttle_ - throttle_for(setup, r.energy + r.turn_power);
    fresh_ = false;
  }
  move_throttle(setup, demand, r, dt);
  move_pitch(setup, demand, view, r, alpha, speed, dt);
  return {pitch_, throttle_};
}

}  // namespace skein::autopilot
