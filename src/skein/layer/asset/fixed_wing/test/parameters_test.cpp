// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/asset/fixed_wing/parameters.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include "skein/base/check.h"
#include "skein/layer/asset/fixed_wing/fixed_wing_plant.h"
#include "skein/layer/asset/fixed_wing/test/aircraft.h"

namespace skein::asset::parameters_test {
namespace {

TEST(FixedWingParameters, ThoseOfTheDocumentsAreValid) {
  for (const FixedWingParameters& p : {aerosonde(), glider(), light_sport()})
    for (const ParameterError& error : errors(p))
      ADD_FAILURE() << error.key << " " << error.message;
}

TEST(FixedWingParameters, WhatCannotFlyIsNamed) {
  struct Case {
    const char* key;
    std::function<void(FixedWingParameters&)> change;
  };
  const auto motor = [](FixedWingParameters& p) -> ElectricMotor& {
    return std::get<ElectricMotor>(p.propulsion);
  };
  const Case cases[] = {
      {"mass", [](auto& p) { p.mass = -1; }},
      {"mass", [](auto& p) { p.mass = std::nan(""); }},
      {"inertia", [](auto& p) { p.inertia.zz = 1; }},
      {"inertia", [](auto& p) { p.inertia.xz = 0.05; }},
      {"geometry.area", [](auto& p) { p.geometry.area = 0; }},
      {"aero.Cmq", [](auto& p) { p.aero.Cmq = 3; }},
      {"aero.CLa", [](auto& p) { p.aero.CLa = std::nan(""); }},
      {"stall.alpha", [](auto& p) { p.stall->alpha = 3; }},
      {"propulsion.K", [&](auto& p) { motor(p).K = 0; }},
      {"propulsion.battery.cells", [&](auto& p) { motor(p).battery.cells = 2.5; }},
      {"servos.lag", [](auto& p) { p.servos.lag = 0; }},
      {"envelope.cruise", [](auto& p) { p.envelope.cruise = 10; }},
      {"envelope.fastest", [](auto& p) { p.envelope.fastest = 14; }},
      {"ground.sink_limit", [](auto& p) { p.ground.sink_limit = 0; }},
      // What only flying shows.
      {"envelope.slowest", [](auto& p) { p.envelope.slowest = 6; }},
      {"envelope.fastest", [](auto& p) { p.envelope.fastest = 40; }},
      {"envelope.slowest", [](auto& p) { p.servos.elevator_max = 0.02; }},
      {"envelope.slowest", [](auto& p) { p.aero.Cl0 = 0.1; }},
  };
  for (const Case& c : cases) {
    FixedWingParameters p = glider();
    c.change(p);
    const auto found = errors(p);
    const bool named = std::any_of(found.begin(), found.end(),
                                   [&](const auto& f) { return f.key == c.key; });
    std::string all;
    for (const ParameterError& f : found) all += f.key + " " + f.message + "; ";
    EXPECT_TRUE(named) << c.key << " is not among: " << all;
    EXPECT_THROW(FixedWingPlant{p}, Bug) << c.key;
  }
}

}  // namespace
}  // namespace skein::asset::parameters_test
