// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/autopilot/skein/sensor_selector.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "skein/base/random.h"

namespace skein::autopilot::sensor_selector_test {
namespace {

using Use = SensorSelector::Use;

Time at(double seconds) {
  return Time::from_seconds(seconds);
}

std::uint8_t bit(FlightSensor sensor) {
  return static_cast<std::uint8_t>(1u << static_cast<unsigned>(sensor));
}

TEST(SensorSelector, FliesByOneUnitUntilItIsSilentThenByTheOther) {
  RandomStream random(8, 0, Purpose::kTest);
  for (int trial = 0; trial < 100; ++trial) {
    const double interval = random.uniform(0.005, 2), end = random.uniform(20, 60);
    SensorSelector sensors(Time(), 0);
    double last_first = -1, switched = -1;
    for (double t = 0; t < 200; t += interval) {
      const bool works = t < end;
      if (works) {
        EXPECT_EQ(sensors.take(FlightSensor::kBarometer, 0, at(t)), Use::kYes);
        last_first = t;
      }
      const Use second = sensors.take(FlightSensor::kBarometer, 1, at(t));
      if (works) {
        EXPECT_EQ(second, Use::kNo);
      }
      if (second == Use::kAnew) {
        EXPECT_LT(switched, 0) << "once";
        switched = t;
      }
      EXPECT_EQ(sensors.lost(at(t)), 0) << t;
    }
    EXPECT_GT(switched, last_first);
    EXPECT_LE(switched - last_first, 3 * interval + 1e-6);
    EXPECT_EQ(sensors.units()[static_cast<std::size_t>(FlightSensor::kBarometer)], 1);
  }
}

TEST(SensorSelector, MissesWhatItHasReceivedAtItsOwnRate) {
  RandomStream random(9, 0, Purpose::kTest);
  for (int trial = 0; trial < 100; ++trial) {
    const double interval = random.uniform(0.01, 3);
    SensorSelector sensors(Time(), 0);
    double t = 0;
    for (int k = 0; k < 50; ++k) {
      EXPECT_EQ(sensors.lost(at(t)), 0);
      t += interval;
      sensors.take(FlightSensor::kAirspeed, 0, at(t));
    }
    const double patience = std::max(1.0, 5 * interval);
    EXPECT_EQ(sensors.lost(at(t + patience - 1e-3)), 0);
    EXPECT_EQ(sensors.lost(at(t + patience + 1e-3)), bit(FlightSensor::kAirspeed));
    sensors.take(FlightSensor::kAirspeed, 0, at(t + 30));
    EXPECT_EQ(sensors.lost(at(t + 30)), 0) << "received again";
  }
}

TEST(SensorSelector, MissesWhatIsFittedAndWasNeverReceived) {
  const SensorSelector sensors(at(10), bit(FlightSensor::kImu));
  EXPECT_EQ(sensors.lost(at(10.1)), 0);
  EXPECT_EQ(sensors.lost(at(10.3)), bit(FlightSensor::kImu));
  EXPECT_EQ(SensorSelector(at(10), 0).lost(at(99)), 0);
}

}  // namespace
}  // namespace skein::autopilot::sensor_selector_test
