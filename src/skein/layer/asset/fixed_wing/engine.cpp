// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/asset/fixed_wing/engine.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "skein/model/atmosphere/atmosphere.h"

namespace skein::asset {
namespace {

// Share of the sea-level power that thinner air leaves.
double air_share(double density) {
  return std::max(0.0, 1.132 * density / model::kSeaLevelDensity - 0.132);
}

// The larger root of a x^2 + b x + c, in a form that needs no a; 0 when there is none
// above 0.
double larger_root(double a, double b, double c) {
  const double d = b * b - 4 * a * c;
  if (!(d > 0)) return 0;
  const double root = std::sqrt(d);
  // The usual form cancels for b > 0, the other one for b < 0.
  return std::max(0.0, b > 0 ? -2 * c / (b + root) : (root - b) / (2 * a));
}

}  // namespace

Engine::Engine(const Propulsion& propulsion) {
  if (const auto* motor = std::get_if<ElectricMotor>(&propulsion)) {
    kind_ = Kind::kElectric;
    lag_ = motor->lag;
    source_ = Battery(motor->battery);
    const double D2 = motor->diameter * motor->diameter;
    const double turns = 1 / (2 * geo::kPi);  // per radian
    t2_ = D2 * D2 * turns * turns * motor->CT0;
    t1_ = D2 * motor->diameter * turns * motor->CT1;
    t0_ = D2 * motor->CT2;
    q2_ = D2 * D2 * motor->diameter * turns * turns * motor->CQ0;
    q1_ = D2 * D2 * turns * motor->CQ1;
    q0_ = D2 * motor->diameter * motor->CQ2;
    K_ = motor->K;
    resistance_ = motor->resistance;
    no_load_current_ = motor->no_load_current;
  } else if (const auto* piston = std::get_if<PistonEngine>(&propulsion)) {
    kind_ = Kind::kPiston;
    lag_ = piston->lag;
    source_ = FuelTank(piston->tank);
    power_max_ = piston->power_max;
    efficiency_ = piston->efficiency;
    V0_ = piston->efficiency * piston->power_max / piston->static_thrust;
  }
}

double Engine::power(double spin, double forward, double density) const {
  if (spin <= 0) return 0;
  if (kind_ == Kind::kPiston) return spin * power_max_ * air_share(density);
  if (kind_ == Kind::kNone) return 0;
  const double current = output(spin, forward, density).torque / K_ + no_load_current_;
  return (current * resistance_ + K_ * spin) * current;
}

double Engine::target(double throttle, double voltage, double forward,
                      double density) const {
  if (throttle <= 0) return 0;
  if (kind_ == Kind::kPiston) return throttle;
  if (kind_ == Kind::kNone) return 0;
  const double V = std::max(0.0, forward);
  const double per_volt = K_ / resistance_;
  return larger_root(
      density * q2_, density * q1_ * V + K_ * per_volt,
      density * q0_ * V * V - throttle * voltage * per_volt + K_ * no_load_current_);
}

Energy Engine::full() const {
  Energy energy;
  if (const auto* battery = std::get_if<Battery>(&source_))
    energy.voltage = battery->open_circuit(1);
  return energy;
}

double Engine::spin_for(double thrust, double forward, double density) const {
  if (thrust <= 0) return 0;
  const double V = std::max(0.0, forward);
  if (kind_ == Kind::kPiston)
    return thrust * std::sqrt(V * V + V0_ * V0_) /
           (efficiency_ * power_max_ * air_share(density));
  if (kind_ == Kind::kNone) return 0;
  return larger_root(t2_, t1_ * V, t0_ * V * V - thrust / density);
}

double Engine::throttle_for(double spin, double forward, double density) const {
  if (spin <= 0) return 0;
  if (kind_ == Kind::kPiston) return spin;
  const auto* battery = std::get_if<Battery>(&source_);
  if (!battery) return 0;
  const double drawn = power(spin, forward, density);
  Energy energy = full();
  if (battery->draw(energy, {}, drawn, 0) < 1)
    return std::numeric_limits<double>::infinity();
  const double current = output(spin, forward, density).torque / K_ + no_load_current_;
  return (current * resistance_ + K_ * spin) / energy.voltage;
}

}  // namespace skein::asset
