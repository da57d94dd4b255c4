// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/asset/body/fuel_tank.h"

#include <algorithm>
#include <limits>

#include "skein/base/check.h"

namespace skein::asset {

std::vector<ParameterError> errors(const FuelTankParameters& p) {
  ParameterCheck check;
  check.above("fuel", p.fuel, 0);
  check.above("consumption", p.consumption, 0);
  check.at_least("idle_consumption", p.idle_consumption, 0);
  return check.take();
}

FuelTank::FuelTank(const FuelTankParameters& parameters)
    : fuel_(parameters.fuel),
      consumption_(parameters.consumption),
      idle_(parameters.idle_consumption) {
  SKEIN_CHECK(errors(parameters).empty());
}

double FuelTank::draw(Energy& energy, const Faults& faults, double power,
                      double dt) const {
  const double asked = std::max(0.0, power);
  energy.voltage = 0;
  if (faults.battery || energy.charge <= 0) {
    energy.power = 0;
    return 0;
  }
  const double burnt = rate(asked) * dt;
  const double left = energy.charge * fuel_;
  const double share = burnt <= left ? 1 : left / burnt;
  energy.charge = burnt < left ? energy.charge - burnt / fuel_ : 0;
  energy.power = share * asked;
  return share;
}

double FuelTank::endurance(const Energy& energy) const {
  const double burning = rate(std::max(0.0, energy.power));
  return burning > 0 ? energy.charge * fuel_ / burning
                     : std::numeric_limits<double>::infinity();
}

}  // namespace skein::asset
