// SPDX-License-Identifier: Apache-2.0
// Flight sensors that fall silent at random times, with and without spares.

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>

#include "skein/assemble/test/whole_flight.h"
#include "skein/base/random.h"

namespace skein::assemble::sensor_loss_test {
namespace {

struct Case {
  const char* plant;
  const char* sensor;
  double at = 0, until = 0;  // [s]
  double wind = 0, from = 0;
  const char* sensors = "[flight]";
  int seed = 0;
  const char* part = nullptr;  // of the failure; null: the sensor
};

constexpr const char* kGlider = "{kind: fixed-wing, aircraft: bixler}";
constexpr const char* kAerosonde = "{kind: fixed-wing, aircraft: aerosonde-stall}";
constexpr const char* kQuad = "multirotor";
constexpr double kDuration = 240;

FlightLog flown(const Case& c) {
  const std::string until = c.until > 0 ? fmt::format("{:.2f}", c.until) : "null";
  return fly(fmt::format(R"(
seed: {}
duration_s: {}
environment: {{terrain: flat, phenomena: [], wind: {{kind: uniform, speed_mps: {}, from_deg: {}}}, turbulence: {{kind: dryden, intensity: light}}}}
missions: []
aircraft:
  - plant: {}
    autopilot: skein
    sensors: {}
    altitude_agl_m: 100
    agent: {{kind: route, points_m: [[500, 0], [500, 500], [0, 500], [0, 0]], laps: 3}}
    start: {{placement: list, positions_m: [[0, 0]], heading_deg: 0}}
    failures: [{{kind: sensor, part: "{}", at_s: {:.2f}, until_s: {}}}]
)",
                         c.seed, kDuration, c.wind, c.from, c.plant, c.sensors,
                         c.part ? c.part : c.sensor, c.at, until));
}

// The first event of that kind whose text begins with the sensor's name.
const Event* reported(const FlightLog& log, EventKind kind, const std::string& sensor) {
  for (const Event& event : log.events)
    if (event.kind == kind && event.text.starts_with(sensor)) return &event;
  return nullptr;
}

double height_off(const FlightLog& log, double from) {
  double max = 0;
  for (const FlightRow& row : log.rows.at(1))
    if (row.time.seconds() > from) max = std::max(max, std::abs(row.altitude() - 100));
  return max;
}

TEST(SensorLoss, OfWhatCanBeDoneWithoutIsReportedAndFlownWithout) {
  RandomStream random(41, 0, Purpose::kTest);
  constexpr std::array kSensors = {"barometer", "magnetometer", "airspeed", "power"};
  for (int trial = 0; trial < 24; ++trial) {
    Case c;
    c.sensor = kSensors[static_cast<std::size_t>(trial) % kSensors.size()];
    const bool pitot = std::string(c.sensor) == "airspeed";
    const double kind = random.uniform();
    c.plant = kind < 0.4 ? kGlider : kind < 0.7 || pitot ? kAerosonde : kQuad;
    c.at = random.uniform(5, 150);
    c.wind = random.uniform(0, 5);
    c.from = random.uniform(0, 360);
    c.seed = trial;
    SCOPED_TRACE(fmt::format("{} without {} from {:.1f} s on, wind {:.1f} from {:.0f}",
                             c.plant, c.sensor, c.at, c.wind, c.from));
    const FlightLog log = flown(c);
    const Event* lost = reported(log, EventKind::kSensorLost, c.sensor);
    ASSERT_NE(lost, nullptr) << log.story();
    EXPECT_GT(lost->text.size(), std::string(c.sensor).size() + 2) << "what is done";
    // Patience: 1 s, and 3 s for the slow battery monitor, and one of its periods.
    EXPECT_NEAR(lost->time.seconds(), c.at, 6);
    EXPECT_EQ(log.find(EventKind::kAccident), nullptr) << log.story();
    EXPECT_EQ(log.find(EventKind::kFailsafe), nullptr) << log.story();
    // A single receiver's height is 8 m wrong, one in 300 times three times as much.
    EXPECT_LT(height_off(log, c.at), 25);
  }
}

TEST(SensorLoss, OfTheOnlyInertialUnitEndsTheFlightAsDefined) {
  RandomStream random(42, 0, Purpose::kTest);
  for (int trial = 0; trial < 6; ++trial) {
    Case c;
    c.sensor = "imu";
    c.plant = trial % 2 ? kGlider : kQuad;
    c.at = random.uniform(5, 150);
    c.seed = trial;
    const FlightLog log = flown(c);
    SCOPED_TRACE(log.story());
    const Event* lost = reported(log, EventKind::kSensorLost, "imu");
    const Event* failsafe = log.find(EventKind::kFailsafe, "imu: descend");
    ASSERT_NE(lost, nullptr);
    ASSERT_NE(failsafe, nullptr);
    EXPECT_NEAR(failsafe->time.seconds(), c.at, 0.5);
    // Motors stop within the second; what is left is the electronics.
    for (const FlightRow& row : log.rows.at(1)) {
      if (row.time.seconds() < c.at + 1.5 || row.truth.on_ground) continue;
      EXPECT_LT(row.truth.energy.power, 20) << row.time.seconds();
    }
  }
}

TEST(SensorLoss, OfAnInertialUnitForAWhileIsSurvivedByAnAircraftThatGlides) {
  RandomStream random(43, 0, Purpose::kTest);
  for (int trial = 0; trial < 8; ++trial) {
    Case c;
    c.sensor = "imu";
    c.plant = kGlider;
    c.at = random.uniform(5, 100);
    c.until = c.at + random.uniform(0.3, 3);
    c.wind = random.uniform(0, 4);
    c.from = random.uniform(0, 360);
    c.seed = trial;
    const FlightLog log = flown(c);
    SCOPED_TRACE(log.story());
    EXPECT_EQ(log.find(EventKind::kAccident), nullptr);
    EXPECT_NE(reported(log, EventKind::kSensorBack, "imu"), nullptr);
    const FlightRow& last = log.rows.at(1).back();
    EXPECT_NEAR(last.altitude(), 100, 25);
  }
}

TEST(SensorLoss, IsNoLossWhereASpareIsFitted) {
  RandomStream random(44, 0, Purpose::kTest);
  constexpr std::array kSensors = {"imu", "barometer", "magnetometer", "airspeed"};
  for (int trial = 0; trial < 16; ++trial) {
    Case c;
    c.sensor = kSensors[static_cast<std::size_t>(trial) % kSensors.size()];
    const bool pitot = std::string(c.sensor) == "airspeed";
    c.plant = random.uniform() < 0.5 || pitot ? kGlider : kQuad;
    const std::string sensors = fmt::format("[flight, {}]", c.sensor);
    const std::string part = std::string(c.sensor) + "#1";
    c.sensors = sensors.c_str();
    c.part = part.c_str();
    c.at = random.uniform(5, 150);
    c.wind = random.uniform(0, 5);
    c.from = random.uniform(0, 360);
    c.seed = trial;
    const FlightLog log = flown(c);
    SCOPED_TRACE(std::string(c.sensor) + "\n" + log.story());
    EXPECT_NE(reported(log, EventKind::kSensorSwitched, c.sensor), nullptr);
    EXPECT_EQ(reported(log, EventKind::kSensorLost, c.sensor), nullptr);
    EXPECT_EQ(log.find(EventKind::kAccident), nullptr);
    EXPECT_EQ(log.find(EventKind::kFailsafe), nullptr);
    EXPECT_LT(height_off(log, c.at), 25);
  }
}

}  // namespace
}  // namespace skein::assemble::sensor_loss_test
