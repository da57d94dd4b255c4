// SPDX-License-Identifier: Apache-2.0
// Cost of random numbers, turbulence and sensors, each per call, and of the usual suite
// of sensors per inner step of a vehicle at 100 Hz.

#include <benchmark/benchmark.h>

#include <memory>
#include <vector>

#include "skein/base/random.h"
#include "skein/data/vehicle/air.h"
#include "skein/layer/environment/turbulence/dryden_turbulence.h"
#include "skein/layer/sensory/airspeed_sensor.h"
#include "skein/layer/sensory/anemometer.h"
#include "skein/layer/sensory/barometer.h"
#include "skein/layer/sensory/camera.h"
#include "skein/layer/sensory/gnss_receiver.h"
#include "skein/layer/sensory/height_sensor.h"
#include "skein/layer/sensory/ideal_navigation.h"
#include "skein/layer/sensory/imu_sensor.h"
#include "skein/layer/sensory/magnetometer.h"
#include "skein/layer/sensory/power_sensor.h"
#include "skein/layer/sensory/rangefinder.h"

namespace skein {
namespace {

void one_normal(benchmark::State& state) {
  RandomStream stream(1, 0, Purpose::kTest);
  double sum = 0;
  for (auto _ : state) sum += stream.normal();
  benchmark::DoNotOptimize(sum);
}
BENCHMARK(one_normal);

void four_normals(benchmark::State& state) {
  RandomStream stream(1, 0, Purpose::kTest);
  double sum = 0;
  for (auto _ : state) {
    const auto n = stream.normals4();
    sum += n[0] + n[1] + n[2] + n[3];
  }
  benchmark::DoNotOptimize(sum);
}
BENCHMARK(four_normals);

// Severe, with the airspeed and height of an aircraft in it: coefficients are renewed as
// often as they are in flight.
void dryden_turbulence(benchmark::State& state) {
  environment::DrydenTurbulence turbulence(
      {.intensity = environment::TurbulenceIntensity::kSevere}, 1, {1});
  VehicleState vehicle;
  double height = 80;
  double followed = 0;  // of the gust, in 1 s
  vehicle.v_N = {20, 3, 0};
  vehicle.airspeed = 20;
  for (auto _ : state) {
    const Gust gust = turbulence.advance({{}, vehicle, height, Vec3(0, 3, 0)}, 0.01);
    followed += 0.01 * (gust.velocity_N.x() - followed);
    vehicle.airspeed = 20 + followed - gust.velocity_N.x();
    height += 0.01 * (gust.velocity_N.z() + 0.2 * (80 - height));
    benchmark::DoNotOptimize(gust.rates_B.sum());
  }
}
BENCHMARK(dryden_turbulence);

class Ground final : public Terrain {
 public:
  double elevation_msl(const Vec2&) const override { return 0; }
  Vec2 gradient(const Vec2&) const override { return Vec2::Zero(); }
};

using Sensors = std::vector<std::unique_ptr<Sensor>>;

// Turning vehicles and their sensors, called as each vehicle's own loop does; one vehicle
// an iteration, in turn.
void inner_steps(benchmark::State& state, const std::vector<Sensors>& fleet) {
  const Ground ground;
  VehicleState start;
  start.airspeed = 20;
  start.p_N = {0, 0, -40};
  start.energy = {.charge = 1, .voltage = 11, .power = 90};
  std::vector<VehicleState> vehicles(fleet.size(), start);
  const Air air;
  const Time step = Time::from_ns(10'000'000);
  const Quat turn = geo::exp_so3({0.001, 0.002, 0.003});
  Time now;
  std::vector<SensorSample> samples;
  std::size_t i = 0;
  for (auto _ : state) {
    VehicleState& vehicle = vehicles[i];
    vehicle.q_NB = vehicle.q_NB * turn;
    vehicle.v_N += Vec3(1e-3, 0, 0);
    samples.clear();
    const SensorView view{now, vehicle, air, ground};
    for (const auto& sensor : fleet[i]) sensor->sample(view, samples);
    benchmark::DoNotOptimize(samples.data());
    if (++i < fleet.size()) continue;
    i = 0;
    now += step;
  }
}

void no_sensor(benchmark::State& state) {
  inner_steps(state, std::vector<Sensors>(1));
}
BENCHMARK(no_sensor);

template <class S, class Options>
void one_sensor(benchmark::State& state) {
  std::vector<Sensors> fleet(1);
  fleet[0].push_back(std::make_unique<S>(Options{}, 1, EntityId{1}));
  inner_steps(state, fleet);
}
BENCHMARK(one_sensor<sensory::ImuSensor, sensory::ImuOptions>);
BENCHMARK(one_sensor<sensory::GnssReceiver, sensory::GnssReceiverOptions>);
BENCHMARK(one_sensor<sensory::Barometer, sensory::BarometerOptions>);
BENCHMARK(one_sensor<sensory::Magnetometer, sensory::MagnetometerOptions>);
BENCHMARK(one_sensor<sensory::AirspeedSensor, sensory::AirspeedOptions>);
BENCHMARK(one_sensor<sensory::PowerSensor, sensory::PowerOptions>);
BENCHMARK(one_sensor<sensory::HeightSensor, sensory::HeightOptions>);
BENCHMARK(one_sensor<sensory::Anemometer, sensory::AnemometerOptions>);
BENCHMARK(one_sensor<sensory::Rangefinder, sensory::RangefinderOptions>);
BENCHMARK(one_sensor<sensory::Lidar, sensory::LidarOptions>);
BENCHMARK(one_sensor<sensory::Camera, sensory::CameraOptions>);

void ideal_navigation(benchmark::State& state) {
  std::vector<Sensors> fleet(1);
  fleet[0].push_back(
      std::make_unique<sensory::IdealNavigation>(sensory::IdealNavigationOptions{}));
  inner_steps(state, fleet);
}
BENCHMARK(ideal_navigation);

Sensors usual_sensors(EntityId self) {
  Sensors sensors;
  sensors.push_back(std::make_unique<sensory::ImuSensor>(sensory::ImuOptions{}, 1, self));
  sensors.push_back(
      std::make_unique<sensory::GnssReceiver>(sensory::GnssReceiverOptions{}, 1, self));
  sensors.push_back(
      std::make_unique<sensory::Barometer>(sensory::BarometerOptions{}, 1, self));
  sensors.push_back(
      std::make_unique<sensory::Magnetometer>(sensory::MagnetometerOptions{}, 1, self));
  sensors.push_back(
      std::make_unique<sensory::AirspeedSensor>(sensory::AirspeedOptions{}, 1, self));
  sensors.push_back(
      std::make_unique<sensory::PowerSensor>(sensory::PowerOptions{}, 1, self));
  return sensors;
}

void usual_suite(benchmark::State& state) {
  std::vector<Sensors> fleet;
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(state.range(0)); ++i)
    fleet.push_back(usual_sensors({i}));
  inner_steps(state, fleet);
}
BENCHMARK(usual_suite)->ArgName("vehicles")->Arg(1)->Arg(100)->Arg(10000);

}  // namespace
}  // namespace skein
