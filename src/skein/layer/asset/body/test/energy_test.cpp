// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "skein/layer/asset/body/energy_source.h"

namespace skein::asset::energy_test {
namespace {

BatteryParameters even_voltage() {
  BatteryParameters p;
  p.cells = 1;
  p.capacity_Ah = 1;
  p.resistance = 0.1;
  p.cutoff = 0;
  p.open_circuit.fill(4);
  return p;
}

TEST(Battery, CurrentGivesThePowerAsked) {
  const Battery battery{BatteryParameters{}};
  Energy energy;
  for (const double power : {0.0, 1e-9, 1.0, 50.0, 150.0}) {
    energy.charge = 1;
    EXPECT_EQ(battery.draw(energy, {}, power, 0.01), 1);
    // The root of the quadratic is good to rounding.
    EXPECT_NEAR(energy.power, power, 1e-13 * power);
    EXPECT_NEAR(energy.voltage, 3 * 4.2 - 0.025 * current(energy), 1e-12);
  }
}

TEST(Battery, EveryStepBalancesItsEnergy) {
  const Battery battery{BatteryParameters{}};
  Energy energy;
  const double dt = 0.01, capacity = 2.2 * 3600, resistance = 0.025;
  double given = 0, heat = 0, chemical = 0;
  while (energy.charge > 0.2) {
    const double before = energy.charge;
    battery.draw(energy, {}, 120, dt);
    const double i = (before - energy.charge) * capacity / dt;
    EXPECT_NEAR(i, current(energy), 1e-9 * i);
    given += energy.power * dt;
    heat += resistance * i * i * dt;
    chemical += battery.open_circuit((before + energy.charge) / 2) * i * dt;
  }
  // The voltage of the step's beginning stands for its middle: off by half a step's
  // change.
  EXPECT_NEAR(given + heat, chemical, 1e-5 * chemical);
}

TEST(Battery, ConstantVoltageLastsAsByHand) {
  const Battery battery{even_voltage()};
  Energy energy;
  battery.draw(energy, {}, 12, 0);
  // 4 I - 0.1 I^2 = 12 => I = 20 - sqrt(280).
  const double by_hand = 3600 / (20 - std::sqrt(280.0));
  EXPECT_NEAR(battery.endurance(energy), by_hand, 1e-9 * by_hand);
  double seconds = 0;
  while (battery.draw(energy, {}, 12, 1) == 1) seconds += 1;
  EXPECT_NEAR(seconds, by_hand, 1);
  EXPECT_EQ(battery.draw(energy, {}, 12, 1), 0);
  EXPECT_EQ(energy.charge, 0);
  EXPECT_EQ(energy.power, 0);
}

TEST(Battery, EnduranceIsTheTimeUntilItGivesLess) {
  const Battery battery{BatteryParameters{}};
  for (const double power : {10.0, 60.0, 200.0}) {
    Energy energy;
    energy.charge = 0.83;
    battery.draw(energy, {}, power, 0);
    const double predicted = battery.endurance(energy);
    double seconds = 0;
    while (battery.draw(energy, {}, power, 0.1) == 1) seconds += 0.1;
    // Steps of 0.1 s, and two Gauss points a segment of the table.
    EXPECT_NEAR(predicted, seconds, 0.1 + 1e-4 * seconds) << power;
  }
}

TEST(Battery, GivesNoMoreThanItsCutOffAllows) {
  const BatteryParameters p;
  const Battery battery(p);
  Energy energy;
  const double share = battery.draw(energy, {}, 1e6, 1e-3);
  EXPECT_NEAR(energy.voltage, 3 * p.cutoff, 1e-12);
  EXPECT_NEAR(share * 1e6, energy.power, 1e-6);
  EXPECT_NEAR(battery.max_power(1), energy.power, 1e-9);
}

TEST(Battery, GivesNoMoreThanItsLargestPower) {
  const Battery battery{even_voltage()};
  Energy energy;
  battery.draw(energy, {}, 1e6, 1e-3);
  EXPECT_NEAR(energy.power, 4 * 4 / (4 * 0.1), 1e-9);  // U0^2 / 4R
}

TEST(Battery, AFaultGivesNothingAndTakesNothing) {
  const Battery battery{BatteryParameters{}};
  Energy energy;
  Faults faults;
  faults.battery = true;
  EXPECT_EQ(battery.draw(energy, faults, 10, 0.01), 0);
  EXPECT_EQ(battery.draw_current(energy, faults, 1, 0.01), 0);
  EXPECT_EQ(energy.charge, 1);
  EXPECT_EQ(energy.voltage, 0);
  EXPECT_EQ(current(energy), 0);
}

TEST(Battery, CurrentAndPowerAgree) {
  const Battery battery{BatteryParameters{}};
  Energy by_power, by_current;
  battery.draw(by_power, {}, 100, 0.01);
  EXPECT_EQ(battery.draw_current(by_current, {}, current(by_power), 0.01), 1);
  EXPECT_NEAR(by_current.power, 100, 1e-10);
  EXPECT_NEAR(by_current.charge, by_power.charge, 1e-15);
}

TEST(Battery, NonsenseTakesNothing) {
  const Battery battery{BatteryParameters{}};
  for (const double power : {-5.0, std::numeric_limits<double>::quiet_NaN()}) {
    Energy energy;
    battery.draw(energy, {}, power, 0.01);
    EXPECT_EQ(energy.charge, 1);
    EXPECT_EQ(energy.power, 0);
  }
}

TEST(Battery, ParameterErrorsNameTheirKeys) {
  BatteryParameters p;
  p.cells = 2.5;
  p.capacity_Ah = -1;
  p.open_circuit[4] = 5;
  const auto found = errors(p);
  ASSERT_EQ(found.size(), 3u);
  EXPECT_EQ(found[0].key, "cells");
  EXPECT_EQ(found[1].key, "capacity_Ah");
  EXPECT_EQ(found[1].message, "-1 must be above 0");
  EXPECT_EQ(found[2].key, "open_circuit[5]");
  EXPECT_TRUE(errors(BatteryParameters{}).empty());
}

TEST(FuelTank, BurnsByWorkAndTime) {
  FuelTankParameters p;
  p.fuel = 10;
  p.consumption = 8e-8;
  p.idle_consumption = 5e-4;
  const FuelTank tank(p);
  Energy energy;
  for (int i = 0; i < 36000; ++i) EXPECT_EQ(tank.draw(energy, {}, 20e3, 0.1), 1);
  // An hour at 20 kW: 72 MJ at 8e-8 kg/J, and 3600 s at 5e-4 kg/s.
  EXPECT_NEAR(tank.fuel(energy.charge), 10 - 5.76 - 1.8, 1e-9);
  EXPECT_NEAR(tank.endurance(energy), 2.44 / 2.1e-3, 1e-6);
}

TEST(FuelTank, EndsInTheStepThatItsFuelEnds) {
  FuelTankParameters p;
  p.fuel = 1;
  p.consumption = 1e-3;
  p.idle_consumption = 0;
  const FuelTank tank(p);
  Energy energy;
  EXPECT_NEAR(tank.draw(energy, {}, 400, 2), 1, 0);
  EXPECT_NEAR(tank.draw(energy, {}, 400, 2), 0.2 / 0.8, 1e-12);
  EXPECT_EQ(energy.charge, 0);
  EXPECT_EQ(tank.draw(energy, {}, 400, 2), 0);
}

TEST(EnergySource, NoneAlwaysGivesUntilItFails) {
  Energy energy;
  Faults faults;
  EXPECT_EQ(draw(EnergySource{}, energy, faults, 100, 1), 1);
  EXPECT_EQ(energy.charge, 1);
  EXPECT_EQ(energy.power, 100);
  faults.battery = true;
  EXPECT_EQ(draw(EnergySource{}, energy, faults, 100, 1), 0);
}

}  // namespace
}  // namespace skein::asset::energy_test
