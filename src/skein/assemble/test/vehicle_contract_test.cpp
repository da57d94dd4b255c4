// SPDX-License-Identifier: Apache-2.0
// Simulated vehicles keep the contract of role/vehicle.h, whatever they are made of.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <memory>
#include <stdexcept>
#include <string>

#include "skein/assemble/world/build.h"
#include "skein/layer/environment/wind/uniform_wind.h"
#include "skein/role/contract/contract.h"
#include "skein/role/vehicle.h"
#include "skein/role/wind_field.h"
#include "skein/scenario/scenario_file.h"

namespace skein::assemble::vehicle_contract_test {
namespace {

struct Flown {
  std::string plant, autopilot, sensors;
};

std::unique_ptr<Vehicle> vehicle_of(const Flown& flown) {
  const KindRegistry kinds;
  const auto read = scenario::read_scenario_text(
      fmt::format(R"(
duration_s: 60
environment: {{terrain: flat, wind: {{kind: uniform, speed_mps: 0}}, phenomena: []}}
missions: [formation]
aircraft:
  - plant: {}
    autopilot: {}
    sensors: [{}]
    agent: wingman
    altitude_agl_m: 200
    start: {{placement: list, positions_m: [[100, 0]], heading_deg: 0}}
)",
                  flown.plant, flown.autopilot, flown.sensors),
      "contract", SKEIN_SOURCE_DIR, kinds.table());
  if (!read.ok()) throw std::runtime_error(read.report());
  auto built = build(*read.scenario, kinds);
  if (!built) throw std::runtime_error(built.error().text());
  return std::move(built.value().world.entities.at(1).vehicle);
}

TEST(SimulatedVehicle, KeepsTheContractOfItsRole) {
  const environment::UniformWind wind({});
  for (const Flown& flown :
       {Flown{"kinematic", "path", "gnss"},
        Flown{"{kind: fixed-wing, aircraft: aerosonde-stall}", "skein", "flight"},
        Flown{"{kind: multirotor, aircraft: quad}", "skein", "flight"}})
    EXPECT_EQ(contract::vehicle_violations([&] { return vehicle_of(flown); }, wind),
              contract::Violations{})
        << flown.plant;
}

}  // namespace
}  // namespace skein::assemble::vehicle_contract_test
