// SPDX-License-Identifier: Apache-2.0
// What holds for every sensor: rate, latency, who gets it, streams of its own.

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <string>

#include "skein/layer/sensory/airspeed_sensor.h"
#include "skein/layer/sensory/anemometer.h"
#include "skein/layer/sensory/barometer.h"
#include "skein/layer/sensory/camera.h"
#include "skein/layer/sensory/gnss_receiver.h"
#include "skein/layer/sensory/height_sensor.h"
#include "skein/layer/sensory/imu_sensor.h"
#include "skein/layer/sensory/magnetometer.h"
#include "skein/layer/sensory/passive_detector.h"
#include "skein/layer/sensory/power_sensor.h"
#include "skein/layer/sensory/rangefinder.h"
#include "skein/layer/sensory/safety_pilot.h"
#include "skein/layer/sensory/test/test_world.h"
#include "skein/layer/sensory/traffic_radar.h"
#include "skein/layer/sensory/traffic_receiver.h"

namespace skein::sensory::sensor_contract_test {
namespace {

using Make = std::function<std::unique_ptr<Sensor>(
    double latency, std::uint64_t seed, std::uint32_t entity, std::uint32_t instance)>;
struct Kind {
  std::string name;
  bool payload;
  Make make;
};

template <class S, class Options>
Kind kind(const std::string& name, bool payload, Options options = {}) {
  return {name, payload,
          [options](double latency, std::uint64_t seed, std::uint32_t entity,
                    std::uint32_t instance) {
            Options o = options;
            o.rate_hz = 10;
            o.latency = latency;
            return std::make_unique<S>(o, seed, EntityId{entity}, instance);
          }};
}

std::vector<Kind> kinds() {
  return {kind<ImuSensor, ImuOptions>("imu", false),
          kind<GnssReceiver, GnssReceiverOptions>("gnss-receiver", false),
          kind<Barometer, BarometerOptions>("barometer", false),
          kind<Magnetometer, MagnetometerOptions>("magnetometer", false),
          kind<AirspeedSensor, AirspeedOptions>("airspeed", false),
          kind<PowerSensor, PowerOptions>("power", false),
          kind<HeightSensor, HeightOptions>("height", false),
          kind<Anemometer, AnemometerOptions>("anemometer", false),
          kind<Rangefinder, RangefinderOptions>("rangefinder", true),
          kind<Lidar, LidarOptions>("lidar", true),
          kind<Camera, CameraOptions>("camera", true),
          kind<TrafficReceiver, TrafficReceiverOptions>("ads-b-in", true),
          kind<TrafficRadar, TrafficRadarOptions>("radar", true),
          kind<PassiveDetector, PassiveDetectorOptions>("passive", true)};
}

TestWorld flying() {
  TestWorld world;
  world.vehicle.p_N = {0, 0, -120};
  world.vehicle.airspeed = 20;
  world.vehicle.energy = {.charge = 0.5, .voltage = 12, .power = 100};
  for (std::uint32_t i = 0; i < 9; ++i)
    world.aircraft.push_back(
        {{500, 10.0 * i, -150}, {20, 0, 0}, 100 + i, {true, true, true}, {}});
  for (std::uint32_t i = 0; i < 9; ++i)
    world.objects.push_back({.id = i, .position = {double(i) - 4, 0}});
  return world;
}

Time time_of(const SensorSample& sample) {
  return std::visit([](const auto& s) { return s.time; }, sample);
}

// All numbers of a sample that errors move.
std::vector<double> numbers(const SensorSample& sample) {
  std::vector<double> all;
  const auto add = [&all](const Vec3& v) { all.insert(all.end(), v.begin(), v.end()); };
  if (const auto* s = std::get_if<ImuSample>(&sample)) add(s->w_NB_B), add(s->f_B);
  if (const auto* s = std::get_if<GnssFix>(&sample)) add(s->p_N), add(s->v_N);
  if (const auto* s = std::get_if<BarometerSample>(&sample)) all = {s->altitude_msl};
  if (const auto* s = std::get_if<MagnetometerSample>(&sample)) add(s->m_B);
  if (const auto* s = std::get_if<AirspeedSample>(&sample)) all = {s->airspeed};
  if (const auto* s = std::get_if<PowerSample>(&sample)) all = {s->voltage, s->current};
  if (const auto* s = std::get_if<HeightSample>(&sample)) all = {s->height_agl};
  if (const auto* s = std::get_if<AnemometerSample>(&sample)) add(s->v_AB_B);
  if (const auto* s = std::get_if<RangeSample>(&sample)) all = {s->range};
  if (const auto* s = std::get_if<DetectionSample>(&sample))
    all = {s->position.x(), s->position.y()};
  if (const auto* s = std::get_if<TrafficBroadcast>(&sample)) add(s->p_N), add(s->v_N);
  if (const auto* s = std::get_if<RadarPlot>(&sample))
    all = {s->range, s->bearing, s->elevation};
  if (const auto* s = std::get_if<TransponderContact>(&sample))
    all = {s->range, s->bearing, s->height.value_or(0)};
  return all;
}

std::vector<double> numbers(const std::vector<SensorSample>& samples) {
  std::vector<double> all;
  for (const SensorSample& sample : samples) {
    const auto some = numbers(sample);
    all.insert(all.end(), some.begin(), some.end());
  }
  return all;
}

TEST(EverySensor, ServesTheAutopilotOrTheAgent) {
  for (const Kind& k : kinds())
    EXPECT_EQ(k.make(0, 1, 1, 0)->payload(), k.payload) << k.name;
  EXPECT_FALSE(SafetyPilot({}).payload());
}

TEST(EverySensor, SamplesComeAfterExactlyTheLatency) {
  const TestWorld world = flying();
  for (const Kind& k : kinds()) {
    for (const int latency_ms : {0, 30, 100, 470}) {
      const auto sensor = k.make(latency_ms / 1000.0, 1, 1, 0);
      int count = 0;
      for (int i = 0; i < 300; ++i) {
        std::vector<SensorSample> out;
        sensor->sample(world.at(ms(10 * i)), out);
        for (const SensorSample& sample : out) {
          EXPECT_EQ(time_of(sample) + ms(latency_ms), ms(10 * i)) << k.name;
          EXPECT_EQ(time_of(sample).ns() % 100'000'000, 0) << k.name;  // at 10 Hz
          ++count;
        }
      }
      EXPECT_GE(count, 24) << k.name;  // 30 measurements, less what is under way
    }
  }
}

TEST(EverySensor, LatencyChangesNothingElse) {
  const TestWorld world = flying();
  for (const Kind& k : kinds()) {
    const auto prompt = k.make(0, 4, 1, 0), late = k.make(0.25, 4, 1, 0);
    auto now = numbers(world.run(*prompt, ms(10), 300));
    const auto later = numbers(world.run(*late, ms(10), 320));
    ASSERT_GE(later.size(), 20U) << k.name;
    now.resize(std::min(now.size(), later.size()));
    EXPECT_TRUE(std::equal(now.begin(), now.end(), later.begin())) << k.name;
  }
}

TEST(EverySensor, HasAStreamOfItsOwn) {
  const TestWorld world = flying();
  for (const Kind& k : kinds()) {
    const auto run = [&](std::uint64_t seed, std::uint32_t entity,
                         std::uint32_t instance) {
      const auto sensor = k.make(0, seed, entity, instance);
      return numbers(world.run(*sensor, ms(10), 100));
    };
    const auto first = run(1, 1, 0);
    ASSERT_FALSE(first.empty()) << k.name;
    EXPECT_EQ(first, run(1, 1, 0)) << k.name;
    EXPECT_NE(first, run(2, 1, 0)) << k.name;
    EXPECT_NE(first, run(1, 2, 0)) << k.name;
    EXPECT_NE(first, run(1, 1, 1)) << k.name;
  }
}

TEST(EverySensor, IsLeftAloneByOthers) {
  // All at once, called in turn as a vehicle does, against each alone.
  const TestWorld world = flying();
  const auto all_kinds = kinds();
  std::vector<std::unique_ptr<Sensor>> all;
  for (const Kind& k : all_kinds) all.push_back(k.make(0, 1, 1, 0));
  std::vector<std::vector<SensorSample>> together(all.size());
  for (int i = 0; i < 100; ++i)
    for (std::size_t k = 0; k < all.size(); ++k)
      all[k]->sample(world.at(ms(10 * i)), together[k]);
  for (std::size_t k = 0; k < all.size(); ++k) {
    const auto alone = all_kinds[k].make(0, 1, 1, 0);
    EXPECT_EQ(numbers(world.run(*alone, ms(10), 100)), numbers(together[k]))
        << all_kinds[k].name;
  }
}

TEST(Delay, TakesMoreThanItWasMadeFor) {
  Delay<HeightSample> delay(1, 1);
  std::vector<SensorSample> out;
  for (int i = 0; i < 100; ++i) delay.put({ms(i), double(i)}, out);
  delay.release(ms(1019), out);
  for (int i = 100; i < 300; ++i) delay.put({ms(i), double(i)}, out);
  delay.release(ms(1500), out);
  ASSERT_EQ(out.size(), 300U);
  for (std::size_t i = 0; i < 300; ++i)
    EXPECT_EQ(std::get<HeightSample>(out[i]).height_agl, double(i));
}

TEST(SafetyPilot, TakesOverAndHandsBack) {
  const TestWorld world;
  SafetyPilot pilot({.takeovers = {{.from = 1,
                                    .until = 2,
                                    .mode = FlightMode::kManual,
                                    .roll = -0.5,
                                    .pitch = 0.25,
                                    .yaw = 0.1,
                                    .throttle = 0.7},
                                   {.from = 3, .until = 3.5}}});
  const auto out = only<PilotInput>(world.run(pilot, ms(10), 400));
  ASSERT_EQ(out.size(), 200U);  // 50 Hz
  for (const PilotInput& input : out) {
    const double t = input.time.seconds();
    const bool first = t >= 1 && t < 2, second = t >= 3 && t < 3.5;
    EXPECT_EQ(input.takes_over, first || second) << t;
    if (first) {
      EXPECT_EQ(input.mode, FlightMode::kManual);
      EXPECT_EQ(input.roll, -0.5);
      EXPECT_EQ(input.pitch, 0.25);
      EXPECT_EQ(input.yaw, 0.1);
      EXPECT_EQ(input.throttle, 0.7);
    } else {
      EXPECT_EQ(input.mode, FlightMode::kStabilized);
    }
  }
}

}  // namespace
}  // namespace skein::sensory::sensor_contract_test
