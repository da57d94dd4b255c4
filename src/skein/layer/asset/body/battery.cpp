// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/asset/body/battery.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "skein/base/check.h"

namespace skein::asset {
namespace {

constexpr double kSegments = 10;  // of the table

}  // namespace

std::vector<ParameterError> errors(const BatteryParameters& p) {
  ParameterCheck check;
  check.at_least("cells", p.cells, 1);
  check.require(p.cells == std::floor(p.cells), "cells", p.cells, "must be whole");
  check.above("capacity_Ah", p.capacity_Ah, 0);
  check.above("resistance", p.resistance, 0);
  check.at_least("cutoff", p.cutoff, 0);
  check.require(p.cutoff < p.open_circuit.back(), "cutoff", p.cutoff,
                "must be below the voltage of a full cell");
  check.above("open_circuit[0]", p.open_circuit[0], 0);
  for (std::size_t i = 1; i < p.open_circuit.size(); ++i)
    check.require(p.open_circuit[i] >= p.open_circuit[i - 1],
                  fmt::format("open_circuit[{}]", i), p.open_circuit[i],
                  "must not be below the voltage at less charge");
  return check.take();
}

Battery::Battery(const BatteryParameters& parameters)
    : open_circuit_(parameters.open_circuit),
      resistance_(parameters.resistance),
      inverse_resistance_(1 / parameters.resistance),
      capacity_(parameters.capacity_Ah * 3600),
      inverse_capacity_(1 / capacity_),
      cutoff_(parameters.cutoff * parameters.cells) {
  SKEIN_CHECK(errors(parameters).empty());
  for (double& voltage : open_circuit_) voltage *= parameters.cells;
}

double Battery::open_circuit(double charge) const {
  const double x = std::clamp(charge, 0.0, 1.0) * kSegments;
  const auto i = static_cast<std::size_t>(std::min(x, kSegments - 1));
  const double part = x - static_cast<double>(i);
  return open_circuit_[i] + part * (open_circuit_[i + 1] - open_circuit_[i]);
}

double Battery::max_current(double open_circuit) const {
  const double lowest = std::max(cutoff_, open_circuit / 2);
  return std::max(0.0, open_circuit - lowest) * inverse_resistance_;
}

// The smaller root, in the form that does not cancel for small powers.
double Battery::current_for(double open_circuit, double power) const {
  const double root = open_circuit * open_circuit - 4 * resistance_ * power;
  return 2 * power / (open_circuit + std::sqrt(std::max(0.0, root)));
}

double Battery::max_power(double charge) const {
  if (charge <= 0) return 0;
  const double u0 = open_circuit(charge);
  const double max = max_current(u0);
  return (u0 - resistance_ * max) * max;
}

void Battery::take(Energy& energy, double open_circuit, double current, double dt) const {
  energy.charge = std::max(0.0, energy.charge - current * dt * inverse_capacity_);
  energy.voltage = open_circuit - resistance_ * current;
  energy.power = energy.voltage * current;
}

double Battery::draw(Energy& energy, const Faults& faults, double power,
                     double dt) const {
  if (faults.battery) {
    energy.voltage = energy.power = 0;
    return 0;
  }
  const double u0 = open_circuit(energy.charge);
  const double asked = std::max(0.0, power);
  double max = max_current(u0);
  if (max * dt > energy.charge * capacity_) max = energy.charge * capacity_ / dt;
  const double max_power = (u0 - resistance_ * max) * max;
  const bool enough = asked <= max_power;
  take(energy, u0, enough ? current_for(u0, asked) : max, dt);
  if (max <= 0) return 0;
  return enough ? 1 : max_power / asked;
}

double Battery::draw_current(Energy& energy, const Faults& faults, double current,
                             double dt) const {
  if (faults.battery) {
    energy.voltage = energy.power = 0;
    return 0;
  }
  const double u0 = open_circuit(energy.charge);
  const double asked = std::max(0.0, current);
  double max = max_current(u0);
  if (max * dt > energy.charge * capacity_) max = energy.charge * capacity_ / dt;
  const bool enough = asked <= max;
  take(energy, u0, enough ? asked : max, dt);
  if (max <= 0) return 0;
  return enough ? 1 : max / asked;
}

// The open-circuit voltage below which `power` cannot be given: max_power() solved.
double Battery::min_open_circuit(double power) const {
  const double product = power * resistance_;
  return product <= cutoff_ * cutoff_ ? cutoff_ + product / cutoff_
                                      : 2 * std::sqrt(product);
}

double Battery::endurance(const Energy& energy) const {
  if (energy.power <= 0) return std::numeric_limits<double>::infinity();
  // The time is the integral of capacity / I(charge). I is smooth between the points of
  // the table, so two Gauss points a segment are good to 1e-4 of the time.
  const double min = min_open_circuit(energy.power);
  double seconds = 0;
  double high = std::clamp(energy.charge, 0.0, 1.0);
  while (high > 0) {
    double low = std::max(0.0, std::ceil(high * kSegments - 1e-9) - 1) / kSegments;
    const double u_high = open_circuit(high), u_low = open_circuit(low);
    if (u_high <= min) break;
    const bool last = u_low < min;
    if (last) low = high - (high - low) * (u_high - min) / (u_high - u_low);
    const double middle = (high + low) / 2;
    const double offset = (high - low) / 2 / std::sqrt(3.0);
    for (const double charge : {middle + offset, middle - offset})
      seconds +=
          (high - low) / 2 * capacity_ / current_for(open_circuit(charge), energy.power);
    if (last) break;
    high = low;
  }
  return seconds;
}

}  // namespace skein::asset
