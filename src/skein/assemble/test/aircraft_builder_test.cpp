// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "skein/assemble/kinds/kinds_of.h"
#include "skein/assemble/kinds/parameter_spread.h"
#include "skein/assemble/kinds/sampling.h"
#include "skein/assemble/world/build.h"
#include "skein/layer/asset/fixed_wing/fixed_wing_plant.h"
#include "skein/scenario/scenario_file.h"
#include "skein/simulation/simulated_vehicle.h"

namespace skein::assemble::aircraft_builder_test {
namespace {

scenario::Scenario read(const std::string& text) {
  auto outcome = scenario::read_scenario_text(text, "test", ".", kind_table());
  EXPECT_TRUE(outcome.ok()) << outcome.report();
  scenario::Scenario scenario;
  if (outcome.ok()) scenario = *std::move(outcome.scenario);
  return scenario;
}

Build built(const std::string& text) {
  auto made = build(read(text), KindRegistry());
  EXPECT_TRUE(made.ok()) << (made.ok() ? "" : made.error().text());
  return made.ok() ? std::move(made).value() : Build{};
}

std::string refusal(const std::string& text) {
  const auto made = build(read(text), KindRegistry());
  EXPECT_FALSE(made.ok());
  return made.ok() ? "" : made.error().text();
}

const simulation::VehicleParts& vehicle(const Build& b, std::size_t k = 1) {
  return parts_of(b.world.entities.at(k));
}

constexpr const char* kWing =
    "aircraft: [{count: 2, plant: fixed-wing, autopilot: skein, sensors: [flight, fire]";

TEST(AircraftBuilder, ThreeWordsMakeAnAircraftWithSixDegreesOfFreedom) {
  const Build b = built(std::string(kWing) + "}]");
  EXPECT_TRUE(std::holds_alternative<FixedWingAirframe>(vehicle(b).plant->airframe()));
  EXPECT_EQ(vehicle(b).step, Time::from_seconds(0.01));
  EXPECT_EQ(vehicle(b).sensors.size(), 7u) << "the suite's sensors one by one";
  EXPECT_EQ(vehicle(b).payload.size(), 1u);
  EXPECT_EQ(vehicle(b, 1).plant, vehicle(b, 2).plant) << "one plant for the group";
  // It begins trimmed: no acceleration to speak of.
  VehicleState state = vehicle(b).state;
  const Vec3 before = state.v_N;
  vehicle(b).plant->step(state, Actuators{{0, vehicle(b).state.actuators[1], 0, 0.7}},
                         vehicle(b).air, 0.01);
  EXPECT_LT((state.v_N - before).norm(), 0.05);
}

TEST(AircraftBuilder, EveryPlantFliesWithEveryAutopilotThatFitsIt) {
  for (const char* plant : {"kinematic", "performance", "fixed-wing", "multirotor"})
    for (const char* sensors : {"ideal-navigation", "flight"}) {
      const Build b = built(fmt::format(
          "aircraft: [{{plant: {}, autopilot: skein, sensors: [{}]}}]", plant, sensors));
      EXPECT_NE(vehicle(b).autopilot, nullptr) << plant;
    }
  built("aircraft: [{plant: performance, autopilot: path}]");
}

TEST(AircraftBuilder, SaysWhyPartsDoNotFit) {
  EXPECT_NE(refusal("aircraft: [{plant: fixed-wing}]").find("Choose the autopilot skein"),
            std::string::npos);
  EXPECT_NE(refusal("aircraft: [{autopilot: skein}]").find("needs a sensor flight, imu"),
            std::string::npos);
  EXPECT_NE(refusal("aircraft: [{plant: {kind: fixed-wing, aircraft: quad}, autopilot: "
                    "skein, sensors: [flight]}]")
                .find("describes plants of kind multirotor only"),
            std::string::npos);
  EXPECT_NE(refusal("aircraft: [{plant: {kind: fixed-wing, aircraft: albatross}, "
                    "autopilot: skein, sensors: [flight]}]")
                .find("albatross"),
            std::string::npos);
  EXPECT_NE(refusal("aircraft: [{start: {on_ground: true}}]").find("cannot stand"),
            std::string::npos);
  EXPECT_NE(refusal("step_s: 0.016\nrecord: {rate_hz: 62.5, metrics_period_s: 0.16}\n"
                    "stations: [{agent_period_s: 0.16}]\n"
                    "aircraft: [{plant: fixed-wing, autopilot: skein, sensors: [flight], "
                    "agent_period_s: 0.16}]")
                .find("flight_step_s"),
            std::string::npos);
}

TEST(AircraftBuilder, StandsOnTheGroundWhereItIsAsked) {
  const Build b = built(
      "environment: {terrain: {kind: flat, elevation_m: 120}}\n"
      "aircraft: [{plant: multirotor, autopilot: skein, sensors: [flight], start: "
      "{on_ground: true}}]");
  EXPECT_TRUE(vehicle(b).state.on_ground);
  EXPECT_EQ(-vehicle(b).state.p_N.z(), 120);
  EXPECT_EQ(vehicle(b).state.v_N, Vec3(Vec3::Zero()));
}

TEST(AircraftBuilder, GustsAreFeltOverTheAircraftsOwnSpan) {
  // Roll rates of the same gusts: those of a wide wing are slower.
  const auto rates = [](const std::string& plant, const std::string& turbulence) {
    const Build b = built(
        "environment: {turbulence: {kind: dryden" + turbulence +
        "}}\naircraft: [{autopilot: skein, sensors: [flight], plant: " + plant + "}]");
    double squares = 0;
    for (int i = 0; i < 200; ++i)
      squares += vehicle(b)
                     .turbulence
                     ->advance({Time::from_seconds(0.01 * i), vehicle(b).state, 100,
                                Vec3::Zero()},
                               0.01)
                     .rates_B.squaredNorm();
    return squares;
  };
  const std::string bixler = "{kind: fixed-wing, aircraft: bixler}";
  EXPECT_EQ(rates("fixed-wing", ""), rates("fixed-wing", ", span_m: 2.8956"));
  EXPECT_EQ(rates(bixler, ""), rates(bixler, ", span_m: 1.5"));
  EXPECT_GT(rates("multirotor", ""), rates("multirotor", ", span_m: 2"));
  EXPECT_EQ(rates("kinematic", ""), rates("kinematic", ", span_m: 2"));
}

TEST(AircraftBuilder, EachAircraftOfASpreadGroupDiffersAndItsAutopilotDoesNotKnow) {
  const Build b = built(std::string(kWing) + ", parameter_spread: 0.1}]");
  EXPECT_NE(vehicle(b, 1).plant, vehicle(b, 2).plant);
  const auto mass = [&](std::size_t k) {
    return std::get<FixedWingAirframe>(vehicle(b, k).plant->airframe()).mass;
  };
  EXPECT_NE(mass(1), mass(2));
  for (const std::size_t k : {1u, 2u}) {
    EXPECT_GT(mass(k), 0.9 * 11);
    EXPECT_LT(mass(k), 1.1 * 11);
  }
}

TEST(ParameterSpread, KeepsAnInertiaOfSomeBodyAndLimitsTheChange) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    asset::FixedWingParameters wing;
    const asset::FixedWingParameters nominal;
    spread(wing, 0.1, RandomStream(seed, 1, Purpose::kAirframe));
    const double factor = wing.inertia.xx / nominal.inertia.xx;
    EXPECT_NEAR(wing.inertia.zz / nominal.inertia.zz, factor, 1e-12);
    EXPECT_LE(std::abs(wing.aero.CLa / nominal.aero.CLa - 1), 0.1);
    EXPECT_LE(std::abs(factor - 1), 0.1);
    EXPECT_EQ(wing.geometry.span, nominal.geometry.span);
  }
}

std::vector<VehicleFault> errors_of(const std::string& keys, std::size_t k = 1) {
  const Build b = built(std::string(kWing) + ", " + keys + "}]");
  return vehicle(b, k).faults;
}

TEST(VehicleFaults, AreThoseOfTheScenario) {
  const auto faults = errors_of(
      "failures: [{at_s: 50, kind: servo-stuck, part: rudder, until_s: 60}, {at_s: 20, "
      "kind: motor}, {at_s: 30, kind: sensor, part: barometer, aircraft: 1}, {at_s: 40, "
      "kind: link}, {at_s: 45, kind: sensor, part: fire}]");
  ASSERT_EQ(faults.size(), 4u) << "one is another aircraft's";
  EXPECT_EQ(faults[0].kind, VehicleFault::Kind::kMotor);
  EXPECT_EQ(faults[0].part, channel::kThrottle);
  EXPECT_EQ(faults[1].kind, VehicleFault::Kind::kLink);
  EXPECT_EQ(faults[2].kind, VehicleFault::Kind::kPayload);
  EXPECT_EQ(faults[3].part, channel::kRudder);
  EXPECT_TRUE(faults[3].active(Time::from_seconds(50)));
  EXPECT_FALSE(faults[3].active(Time::from_seconds(60)));
  EXPECT_TRUE(faults[0].active(Time::from_seconds(3600))) << "for good";
}

TEST(VehicleFaults, OfOneKindOfSensorAreAllOfThem) {
  const auto all = errors_of("failures: [{at_s: 1, kind: sensor}]");
  EXPECT_EQ(all.size(), 8u);
}

TEST(VehicleFaults, NameThePartsThatThereAre) {
  const auto refused = [](const std::string& failure) {
    return refusal(std::string(kWing) + ", failures: [{at_s: 1, " + failure + "}]}]");
  };
  EXPECT_NE(refused("kind: servo-loose, part: flap").find("aileron, elevator and rudder"),
            std::string::npos);
  EXPECT_NE(refused("kind: motor, part: '9'").find("channels 3 to 3"), std::string::npos);
  EXPECT_NE(refused("kind: sensor, part: radar").find("imu, gnss-receiver"),
            std::string::npos);
  EXPECT_NE(refusal("aircraft: [{failures: [{at_s: 1, kind: motor}]}]").find("no motor"),
            std::string::npos);
}

TEST(VehicleFaults, ByChanceAreExponentialAndEachAircraftHasItsOwn) {
  double sum = 0;
  int count = 0;
  std::set<std::int64_t> first;
  for (int seed = 1; seed <= 60; ++seed) {
    const Build b = built(fmt::format(
        "seed: {}\n{}, random_failures: [{{kind: link, mean_between_s: 300, length_s: "
        "20}}]}}]",
        seed, kWing));
    for (const std::size_t k : {1u, 2u}) {
      const auto& faults = vehicle(b, k).faults;
      Time before;
      for (const VehicleFault& fault : faults) {
        sum += (fault.at - before).seconds();
        ++count;
        before = fault.until;
        EXPECT_NEAR((fault.until - fault.at).seconds(), 20, 1e-9);
      }
      if (!faults.empty()) first.insert(faults.front().at.ns());
    }
  }
  EXPECT_GT(first.size(), 115u);
  // Cut off at 3600 s, so a little less than 300; 1,300 draws: 3 sigma is 25 s.
  EXPECT_NEAR(sum / count, 290, 30);
}

TEST(Sampling, FlightSensorsSampleAtTheVehiclesOwnStep) {
  EXPECT_TRUE(sampling_warnings(read(std::string(kWing) + "}]"), kind_table()).empty());
  const auto warnings = sampling_warnings(
      read("aircraft: [{plant: fixed-wing, autopilot: skein, sensors: [{kind: imu, "
           "rate_hz: 400}]}]"),
      kind_table());
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("flight_step_s 0.01"), std::string::npos) << warnings[0];
  EXPECT_EQ(
      truth_period(read("aircraft: [{sensors: [imu, camera, fire]}]"), kind_table()),
      Time::from_seconds(1))
      << "only the fire sensor looks at the fire";
}

}  // namespace
}  // namespace skein::assemble::aircraft_builder_test
