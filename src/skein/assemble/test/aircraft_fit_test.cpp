// SPDX-License-Identifier: Apache-2.0
#include "skein/assemble/kinds/aircraft_fit.h"

#include <gtest/gtest.h>

#include "skein/assemble/kinds/kinds_of.h"
#include "skein/assemble/world/build.h"
#include "skein/layer/asset/multirotor/multirotor_plant.h"
#include "skein/layer/sensory/ideal_navigation.h"
#include "skein/scenario/scenario_file.h"

namespace skein::assemble::aircraft_fit_test {
namespace {

// What a scenario with one group of aircraft is refused for; nothing when it is built.
std::string said_of(const std::string& aircraft, const std::string& rest = "",
                    const KindRegistry& kinds = KindRegistry()) {
  const auto read = scenario::read_scenario_text(
      "aircraft: [{" + aircraft + "}]\n" + rest, "test", ".", kinds.table());
  if (!read.ok()) return read.report();
  const auto made = build(*read.scenario, kinds);
  return made ? "" : made.error().text();
}

void expect_said(const std::string& aircraft, const std::string& part,
                 const std::string& rest = "") {
  const std::string said = said_of(aircraft, rest);
  EXPECT_NE(said.find(part), std::string::npos) << aircraft << "\n" << said;
}

std::string skein(const std::string& options, const std::string& plant = "fixed-wing") {
  return "plant: " + plant + ", sensors: [flight, fire], autopilot: {kind: skein, " +
         options + "}";
}

TEST(AircraftFit, TheAutopilotNeedsToKnowWhereItIs) {
  const std::string group = "plant: fixed-wing, autopilot: skein, sensors: ";
  expect_said(group + "[imu]", "no sensor gives a position");
  expect_said(group + "[imu, barometer, magnetometer]", "gnss-receiver");
  expect_said(group + "[gnss, air-data]", "no sensor gives inertial samples");
  expect_said(group + "[fire]", "neither of both");
  for (const char* enough :
       {"[imu, gnss-receiver]", "[imu, gnss]", "[flight]", "[ideal-navigation]"})
    EXPECT_EQ(said_of(group + enough), "") << enough;
}

TEST(AircraftFit, GainsAreOfItsAirframe) {
  const std::string wing = "wing_gains: {roll_gain_per_s: 3}";
  const std::string rotors = "rotor_gains: {position_gain_per_s: 1}";
  expect_said(skein(rotors),
              "autopilot.rotor_gains: are for multirotors: on a plant of "
              "kind fixed-wing they have no effect");
  expect_said(skein(wing, "multirotor"), "autopilot.wing_gains: are for fixed wings");
  expect_said(skein(wing, "kinematic"), "autopilot.wing_gains");
  EXPECT_EQ(said_of(skein(wing)), "");
  EXPECT_EQ(said_of(skein(rotors, "multirotor")), "");
}

TEST(AircraftFit, FailsafesWaitForLongerThanTheirSensorsAreSilent) {
  expect_said(skein("failsafe: {link: {delay_s: 0}}"),
              "autopilot.failsafe.link.delay_s: 0 must be above 1");
  expect_said(skein("failsafe: {link: {delay_s: 5}}"), "must be above 10",
              "stations: [{heartbeat_s: 10}]");
  // 5 fixes a second, 0.1 s late.
  expect_said(skein("failsafe: {gnss: {delay_s: 0}}"),
              "autopilot.failsafe.gnss.delay_s: 0 must be above 0.3");
  const std::string slow =
      "plant: fixed-wing, autopilot: skein, sensors: [imu, {kind: gnss-receiver, "
      "rate_hz: 0.25, latency_s: 0}]";
  expect_said(slow, "delay_s: 2 must be above 4");
  EXPECT_EQ(said_of(skein("failsafe: {link: {delay_s: 1.5}, gnss: {delay_s: 0.5}}")), "");
  // Without heartbeats nothing is known of how often the station is received.
  EXPECT_EQ(
      said_of(skein("failsafe: {link: {delay_s: 0.5}}"), "stations: [{heartbeat_s: 0}]"),
      "");
}

TEST(AircraftFit, AFenceHoldsTheStartAndDoesNotCrossItself) {
  const std::string at = ", start: {placement: list, positions_m: [[50, 60]]}";
  expect_said(
      skein("fence: {areas_m: [[[0, 0], [100, 100], [100, 0], [0, 100]]]}") + at,
      "fence.areas_m: area 1 crosses itself at 50 m north, 50 m east, between its "
      "corners 1 and 2, and 3 and 4");
  const std::string square = "areas_m: [[[0, 0], [100, 0], [100, 100], [0, 100]]]";
  EXPECT_EQ(said_of(skein("fence: {" + square + "}") + at), "");
  expect_said(
      skein("fence: {" + square + ", margin_m: 45}") + at,
      "does not hold the start at 50 m north, 60 m east, 120 m above sea level: it "
      "is 5 m outside, with the margin of 45 m");
  expect_said(skein("fence: {ceiling_msl_m: 100}") + at, "it is 20 m outside");
  expect_said(skein("fence: {floor_msl_m: 130}") + at, "it is 10 m outside");
  // On the ground it may stand below the floor: it takes off through it.
  EXPECT_EQ(
      said_of(skein("fence: {floor_msl_m: 30}") +
              ", start: {placement: list, positions_m: [[50, 60]], on_ground: true}"),
      "");
}

TEST(AircraftFit, TheAirAtItsAltitudeCarriesIt) {
  const std::string bixler = ", plant: {kind: fixed-wing, aircraft: bixler}";
  const std::string skein = "autopilot: skein, sensors: [flight]";
  expect_said(skein + bixler + ", altitude_agl_m: 20000", "too thin to fly level");
  expect_said(skein + bixler + ", start: {on_ground: true}, altitude_agl_m: 20000",
              "altitude_agl_m: the commanded altitude is 20000 m");
  expect_said(skein + ", plant: multirotor, altitude_agl_m: 15000", "too thin");
  expect_said("plant: performance, altitude_agl_m: 15000", "too thin");
  EXPECT_EQ(said_of(skein + bixler + ", altitude_agl_m: 3000"), "");
  EXPECT_EQ(said_of(skein + ", plant: multirotor, altitude_agl_m: 3000"), "");
  EXPECT_EQ(said_of("plant: kinematic, altitude_agl_m: 15000"), "");
}

TEST(AircraftFit, AllIncompatibilitiesAreReportedAtOnce) {
  const std::string said = said_of(
      skein("rotor_gains: {}, failsafe: {gnss: {delay_s: 0}, link: {delay_s: 0}}"));
  EXPECT_NE(said.find("3 problems"), std::string::npos) << said;
}

struct NoKeys {};

// A plant and a sensor as a plugin brings them.
KindRegistry with_plugin() {
  KindsByRole more;
  more.plant.add(
      "my-rotors", "Multirotor.", scenario::Fields<NoKeys>(),
      [](const NoKeys&, const AircraftContext&) {
        return std::make_unique<asset::MultirotorPlant>(asset::MultirotorParameters{});
      });
  more.sensor.add("my-navigation", "Says everything.", scenario::Fields<NoKeys>(),
                  [](const NoKeys&, const AircraftContext&) {
                    return std::make_unique<sensory::IdealNavigation>(
                        sensory::IdealNavigationOptions{});
                  });
  KindRegistry kinds;
  const auto added = kinds.add(more, "plugin");
  EXPECT_TRUE(added.ok()) << added.error().text();
  return kinds;
}

TEST(AircraftFit, PlantsOfPluginsThatTakeActuatorsNeedAStep) {
  const KindRegistry kinds = with_plugin();
  const std::string group = "plant: my-rotors, autopilot: skein, sensors: [flight]";
  const std::string said = said_of(group, "", kinds);
  EXPECT_NE(said.find("flight_step_s: is needed"), std::string::npos) << said;
  EXPECT_EQ(said_of(group + ", flight_step_s: 0.01", "", kinds), "");
}

TEST(AircraftFit, SensorsOfPluginsMayServeTheAutopilot) {
  EXPECT_EQ(said_of("plant: multirotor, autopilot: skein, sensors: [my-navigation]", "",
                    with_plugin()),
            "");
}

std::vector<std::string> doubts_of(const std::string& aircraft,
                                   const std::string& rest = "") {
  const auto read = scenario::read_scenario_text(
      "aircraft: [{" + aircraft + "}]\n" + rest, "test", ".", kind_table());
  EXPECT_TRUE(read.ok()) << read.report();
  return build(*read.scenario, KindRegistry()).value().warnings;
}

TEST(AircraftFit, SlowRotorsGiveAWarning) {
  // The quadrotor's motors let it tilt with a gain of 5 /s.
  EXPECT_TRUE(doubts_of(skein("rotor_gains: {}", "multirotor")).empty());
  const auto said =
      doubts_of(skein("rotor_gains: {velocity_gain_per_s: 5.1}", "multirotor"));
  ASSERT_EQ(said.size(), 1u);
  EXPECT_NE(said[0].find("it will swing"), std::string::npos) << said[0];
}

TEST(AircraftFit, AStationWithoutHeartbeatsGivesAWarning) {
  const auto silent =
      doubts_of(skein("rounds_corners: true"), "stations: [{heartbeat_s: 0}]");
  ASSERT_EQ(silent.size(), 1u);
  EXPECT_NE(silent[0].find("failsafe link of scout-1 acts"), std::string::npos);
  EXPECT_TRUE(doubts_of(skein("rounds_corners: true")).empty());
}

}  // namespace
}  // namespace skein::assemble::aircraft_fit_test
