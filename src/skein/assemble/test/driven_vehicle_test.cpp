// SPDX-License-Identifier: Apache-2.0
// Vehicles whose plant is here and whose autopilot is elsewhere, as scenarios have them.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "skein/assemble/world/build.h"
#include "skein/layer/environment/wind/uniform_wind.h"
#include "skein/role/contract/contract.h"
#include "skein/role/vehicle.h"
#include "skein/role/wind_field.h"
#include "skein/scenario/scenario_file.h"

namespace skein::assemble::driven_vehicle_test {
namespace {

constexpr const char* kAerosonde = "{kind: fixed-wing, aircraft: aerosonde}";

Result<Build> driven_build(const std::string& physics, const std::string& plant,
                           const std::string& more = "") {
  const KindRegistry kinds;
  const auto read =
      scenario::read_scenario_text(fmt::format(R"(
duration_s: 60
environment: {{terrain: flat, wind: {{kind: uniform, speed_mps: 0}}, phenomena: []}}
missions: []
aircraft:
  - count: 1
    vehicle: {{kind: mavlink, endpoint: "udpin:0", physics: {}}}
    plant: {}
    agent: scout
    sensors: [gnss, fire]
    altitude_agl_m: 200
    start: {{placement: list, positions_m: [[100, 0]], heading_deg: 0}}
    {}
)",
                                               physics, plant, more),
                                   "driven", SKEIN_SOURCE_DIR, kinds.table());
  if (!read.ok()) return Error{ErrorCode::kBadInput, "", read.report(), ""};
  return build(*read.scenario, kinds);
}

std::string driven_error(const std::string& physics, const std::string& plant,
                         const std::string& more = "") {
  const auto built = driven_build(physics, plant, more);
  return built ? std::string() : built.error().text();
}

TEST(DrivenVehicle, IsTheWorldsAndGoesAsFastAsItsAutopilot) {
  const auto json = driven_build("{kind: ardupilot-json, port: 9}", kAerosonde);
  ASSERT_TRUE(json) << json.error().text();
  EXPECT_FALSE(json.value().mixed);
  EXPECT_EQ(json.value().world.entities[1].reality.presence, Reality::kVirtual);
  ASSERT_TRUE(json.value().world.entities[1].vehicle->truth());
  EXPECT_NEAR(json.value().world.entities[1].vehicle->truth()->p_N.x(), 100, 1e-9);
  const auto serial =
      driven_build("{kind: hil-serial, at: 'serial:/dev/none:57600'}", kAerosonde);
  ASSERT_TRUE(serial) << serial.error().text();
  EXPECT_TRUE(serial.value().mixed);
  const auto none = driven_build("{kind: none}", kAerosonde);
  ASSERT_TRUE(none);
  EXPECT_TRUE(none.value().mixed);
  EXPECT_EQ(none.value().world.entities[1].reality.presence, Reality::kPhysical);
  EXPECT_FALSE(none.value().world.entities[1].vehicle->truth());
}

TEST(DrivenVehicle, NeedsAPlantWithActuators) {
  const std::string error = driven_error("{kind: ardupilot-json}", "kinematic");
  EXPECT_NE(error.find("no actuators that an outside autopilot could move"),
            std::string::npos)
      << error;
  EXPECT_NE(error.find("Choose fixed-wing or multirotor"), std::string::npos) << error;
}

TEST(DrivenVehicle, SaysWhatElseDoesNotFit) {
  const auto has = [](const std::string& text, const char* part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  has(driven_error("{kind: px4-hil, outputs: [flap]}", kAerosonde), "\"flap\"");
  has(driven_error("{kind: hil-serial}", kAerosonde), "is needed: the line");
  has(driven_error("{kind: hil-serial, at: 'serial:/dev/none', program: [px4]}",
                   kAerosonde),
      "has no program");
  has(driven_error("{kind: px4-hil, at: nowhere}", kAerosonde), "physics.at");
  has(driven_error("{kind: ardupilot-json}", kAerosonde,
                   "failures: [{kind: sensor, part: gnss, at_s: 5}]"),
      "its autopilot's");
  EXPECT_EQ(driven_error("{kind: ardupilot-json}", kAerosonde,
                         "failures: [{kind: motor, at_s: 5}]"),
            "");
  EXPECT_EQ(driven_error("{kind: px4-hil}", "{kind: multirotor, aircraft: quad}"), "");
}

TEST(DrivenVehicle, PartsOfThePlantCanBeMadeToFail) {
  auto built = driven_build("{kind: ardupilot-json}", kAerosonde);
  ASSERT_TRUE(built);
  Vehicle& vehicle = *built.value().world.entities[1].vehicle;
  EXPECT_TRUE(vehicle.set_fault("motor", true, Time()));
  EXPECT_TRUE(vehicle.set_fault("link", true, Time()));
  EXPECT_TRUE(vehicle.set_fault("sensor fire", true, Time()));
  EXPECT_FALSE(vehicle.set_fault("sensor gnss", true, Time())) << "the autopilot's";
}

// Without its autopilot it answers no command, and keeps all else of the contract.
TEST(DrivenVehicle, KeepsTheContractOfItsRoleButForAnswers) {
  const environment::UniformWind wind({});
  std::vector<Build> builds;  // outlive their vehicles
  const auto make = [&] {
    auto built =
        driven_build("{kind: ardupilot-json}", "{kind: multirotor, aircraft: quad}",
                     "flight_step_s: 0.01");
    EXPECT_TRUE(built) << built.error().text();
    builds.push_back(std::move(built).value());
    return std::move(builds.back().world.entities.at(1).vehicle);
  };
  EXPECT_EQ(contract::vehicle_violations(make, wind),
            contract::Violations{"a command is not answered"});
}

}  // namespace
}  // namespace skein::assemble::driven_vehicle_test
