// The estimator with the real sensors, plant and turbulence: control flies by the
// estimate.

#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include <cmath>
#include <memory>
#include <vector>

#include "layer/asset/fixed_wing/fixed_wing_plant.h"
#include "layer/asset/fixed_wing/test/aircraft.h"
#include "layer/autopilot/control/fixed_wing_control.h"
#include "layer/autopilot/estimator/flight_estimator.h"
#include "layer/environment/turbulence/dryden_turbulence.h"
#include "layer/sensory/airspeed_sensor.h"
#include "layer/sensory/barometer.h"
#include "layer/sensory/gnss_receiver.h"
#include "layer/sensory/imu_sensor.h"
#include "layer/sensory/magnetometer.h"
#include "layer/sensory/test/test_world.h"

namespace skein {
namespace {

namespace error = autopilot::error;

constexpr double kStep = 0.01;
constexpr int kRuns = 50;
constexpr int kSeconds = 180;
constexpr double kModerate = 15.4;  // wind at 6 m of moderate turbulence: 30 knots [m/s]

struct Case {
  Vec3 wind = Vec3::Zero();
  double wind_6m = 0;   // that makes the turbulence
  bool outage = false;  // of satellites, from 100 s to 130 s
};

struct Outcome {
  std::vector<double> nees = std::vector<double>(kSeconds, 0.0);  // mean over the runs
  double position_rms = 0, velocity_rms = 0, attitude_rms = 0, wind_rms = 0;
  double drift = 0;  // RMS of what half a minute without satellites adds [m]
  bool lost = false;
};

double nees(const VehicleState& truth, const autopilot::FlightEstimator& estimator) {
  autopilot::Navigated x = estimator.navigated();
  x.p_N = truth.p_N;
  x.v_N = truth.v_N;
  x.q_NB = truth.q_NB;
  const autopilot::ErrorVector e = difference(x, estimator.navigated());
  Eigen::Matrix<double, 9, 9> p;
  Eigen::Matrix<double, 9, 1> v;
  for (int i = 0; i < 9; ++i) {
    const auto r = error::kAttitude + static_cast<std::size_t>(i);
    v[i] = e[r];
    for (int j = 0; j < 9; ++j)
      p(i, j) = estimator.covariance()(r, error::kAttitude + static_cast<std::size_t>(j));
  }
  return v.dot(p.llt().solve(v));
}

void fly(const Case& c, std::uint64_t seed, Outcome& out) {
  const asset::FixedWingParameters parameters = asset::aerosonde();
  const asset::FixedWingPlant plant(parameters);
  const auto airframe = std::get<FixedWingAirframe>(plant.airframe());
  sensory::TestWorld world;
  world.vehicle =
      plant.start({Vec3(0, 0, -150), 0.1 * static_cast<double>(seed), c.wind});
  environment::DrydenTurbulence turbulence(
      {.wind20 = c.wind_6m, .span = parameters.geometry.span}, seed, EntityId{0});
  std::vector<std::unique_ptr<Sensor>> sensors;
  sensory::GnssReceiverOptions gnss;
  if (c.outage) gnss.outages.spans = {{100, 125}};  // and 5 s to find them again
  sensors.push_back(
      std::make_unique<sensory::ImuSensor>(sensory::ImuOptions{}, seed, EntityId{0}));
  sensors.push_back(std::make_unique<sensory::GnssReceiver>(gnss, seed, EntityId{0}));
  sensors.push_back(std::make_unique<sensory::Barometer>(sensory::BarometerOptions{},
                                                         seed, EntityId{0}));
  sensors.push_back(std::make_unique<sensory::Magnetometer>(
      sensory::MagnetometerOptions{}, seed, EntityId{0}));
  sensors.push_back(std::make_unique<sensory::AirspeedSensor>(sensory::AirspeedOptions{},
                                                              seed, EntityId{0}));

  FastNormals normal(RandomStream(seed, 0, Purpose::kTest));
  const auto draw = [&normal](double sd) {
    const double x = normal(), y = normal(), z = normal();
    return Vec3(sd * Vec3(x, y, z));
  };
  autopilot::EstimatorStart start;
  start.sd = {2, 2, 0.3, 0.02, 0.02, 2};
  start.p_N = world.vehicle.p_N + draw(2);
  start.v_N = world.vehicle.v_N + draw(0.3);
  start.q_NB = geo::exp_so3(draw(0.02)) * world.vehicle.q_NB;
  start.wind_N = c.wind.head<2>() + draw(2).head<2>();
  autopilot::FlightEstimator estimator({}, start);
  autopilot::FixedWingControl control(airframe, {});
  autopilot::FixedWingDemand demand;
  demand.airspeed = airframe.cruise;

  Time now;
  std::vector<SensorSample> samples;
  const auto sense = [&] {
    samples.clear();
    for (const auto& sensor : sensors) sensor->sample(world.at(now), samples);
    for (const SensorSample& sample : samples) estimator.sense(sample);
  };
  sense();
  Vec3 before_outage = Vec3::Zero();
  for (std::size_t t = 0; t < kSeconds; ++t) {
    const bool turns = t % 60 >= 20;
    demand.lateral_acceleration = !turns ? 0 : t % 60 < 40 ? 4 : -4;
    demand.altitude_msl = t % 120 < 60 ? 150 : 180;
    for (int k = 0; k < 100; ++k) {
      const Actuators u = control.control(demand, estimator.state(), kStep);
      const Gust gust =
          turbulence.advance({now, world.vehicle, -world.vehicle.p_N.z(), c.wind}, kStep);
      world.air.wind_N = c.wind + gust.velocity_N;
      world.air.rates_B = gust.rates_B;
      plant.step(world.vehicle, u, world.air, kStep);
      now += Time::from_seconds(kStep);
      sense();
    }
    const VehicleState& s = world.vehicle;
    const autopilot::NavState& nav = estimator.state();
    out.lost = out.lost || !(s.p_N.z() < 0) || !(geo::down_in_body(s.q_NB).z() > 0);
    out.nees[t] += nees(s, estimator) / kRuns;
    if (t == 99) before_outage = nav.p_N - s.p_N;
    if (t == 129) out.drift += (nav.p_N - s.p_N - before_outage).squaredNorm() / kRuns;
    if (t < 60) continue;
    const double share = 1.0 / (kRuns * (kSeconds - 60));
    out.position_rms += (nav.p_N - s.p_N).squaredNorm() * share;
    out.velocity_rms += (nav.v_N - s.v_N).squaredNorm() * share;
    out.attitude_rms += geo::log_so3(s.q_NB * nav.q_NB.conjugate()).squaredNorm() * share;
    out.wind_rms += (nav.wind_N - c.wind).squaredNorm() * share;
  }
}

Outcome fly(const Case& c) {
  Outcome out;
  for (std::uint64_t seed = 1; seed <= kRuns; ++seed) fly(c, seed, out);
  for (double* x : {&out.position_rms, &out.velocity_rms, &out.attitude_rms,
                    &out.wind_rms, &out.drift})
    *x = std::sqrt(*x);
  return out;
}

// 95 % band of the mean over the runs of a chi-square with 9 degrees. Its mean over time
// must be in it, and most seconds: errors of satellites last for half an hour, so that
// the seconds are not independent of each other.
void expect_consistent(const Outcome& out) {
  EXPECT_FALSE(out.lost);
  const double half = 1.96 * std::sqrt(18.0 / kRuns);
  double mean = 0, inside = 0;
  for (double x : out.nees) {
    mean += x / kSeconds;
    inside += std::abs(x - 9) < half ? 1.0 / kSeconds : 0;
  }
  EXPECT_NEAR(mean, 9, half);
  EXPECT_GT(inside, 0.7);
  ::testing::Test::RecordProperty("nees", std::to_string(mean));
  std::printf(
      "NEES %.2f, %.0f %% in band; RMS %.2f m %.3f m/s %.2f deg, wind %.2f m/s, "
      "drift %.1f m\n",
      mean, 100 * inside, out.position_rms, out.velocity_rms,
      geo::degrees(out.attitude_rms), out.wind_rms, out.drift);
}

TEST(EstimatorFlight, IsConsistentInTurnsAndClimbs) {
  expect_consistent(fly(Case{}));
}

TEST(EstimatorFlight, IsConsistentThroughHalfAMinuteWithoutSatellites) {
  const Outcome out = fly({.outage = true});
  expect_consistent(out);
  EXPECT_LT(out.drift, 10);
}

TEST(EstimatorFlight, IsConsistentInWindWithTurbulence) {
  const Outcome out = fly({.wind = {4.8, 6.4, 0}, .wind_6m = kModerate});
  expect_consistent(out);
  EXPECT_LT(out.wind_rms, 2);  // gusts of 2.2 m/s per axis
}

TEST(EstimatorFlight, IsConsistentInTurbulenceWithoutSatellites) {
  const Outcome out = fly({.wind = {4.8, 6.4, 0}, .wind_6m = kModerate, .outage = true});
  expect_consistent(out);
  EXPECT_LT(out.drift, 10);
}

}  // namespace
}  // namespace skein
