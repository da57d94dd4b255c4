// SPDX-License-Identifier: Apache-2.0
// The estimator with the real sensors, plant and turbulence: control flies by the
// estimate.

#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include "skein/layer/asset/fixed_wing/fixed_wing_plant.h"
#include "skein/layer/asset/fixed_wing/test/aircraft.h"
#include "skein/layer/asset/multirotor/multirotor_plant.h"
#include "skein/layer/autopilot/control/fixed_wing_control.h"
#include "skein/layer/autopilot/control/multirotor_control.h"
#include "skein/layer/autopilot/estimator/flight_estimator.h"
#include "skein/layer/environment/turbulence/dryden_turbulence.h"
#include "skein/layer/sensory/airspeed_sensor.h"
#include "skein/layer/sensory/barometer.h"
#include "skein/layer/sensory/gnss_receiver.h"
#include "skein/layer/sensory/imu_sensor.h"
#include "skein/layer/sensory/magnetometer.h"
#include "skein/layer/sensory/test/test_world.h"

namespace skein::estimator_flight_test {
namespace {

namespace error = autopilot::error;

constexpr double kStep = 0.01;
constexpr int kRuns = 50;
constexpr int kSeconds = 180;
constexpr double kModerate = 15.4;  // wind at 6 m of moderate turbulence: 30 knots [m/s]

enum class Manner { kTurns, kStraight, kOrbit };

struct Case {
  Vec3 wind = Vec3::Zero();
  double wind_6m = 0;   // that makes the turbulence
  bool outage = false;  // of satellites, from 100 s to 130 s
  GnssKind kind = GnssKind::kSingle;
  Manner manner = Manner::kTurns;
  bool nobody_knows = false;  // the place and the wind at the start
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

// One aircraft with its sensors and its estimator.
class Aircraft {
 public:
  Aircraft(const Case& c, const Plant& plant, const VehicleState& start, double span,
           std::uint64_t seed)
      : case_(c),
        plant_(plant),
        wing_(std::holds_alternative<FixedWingAirframe>(plant.airframe())),
        turbulence_({.wind20 = c.wind_6m, .span = span}, seed, EntityId{0}),
        normal_(RandomStream(seed, 0, Purpose::kTest)),
        estimator_(options(), start_near(start)) {
    world_.vehicle = start;
    sensory::GnssReceiverOptions gnss;
    gnss.kind = c.kind;
    if (c.outage) gnss.outages.spans = {{100, 125}};  // and 5 s to find them again
    const EntityId me{0};
    sensors_.push_back(
        std::make_unique<sensory::ImuSensor>(sensory::ImuOptions{}, seed, me));
    sensors_.push_back(std::make_unique<sensory::GnssReceiver>(gnss, seed, me));
    sensors_.push_back(
        std::make_unique<sensory::Barometer>(sensory::BarometerOptions{}, seed, me));
    sensors_.push_back(std::make_unique<sensory::Magnetometer>(
        sensory::MagnetometerOptions{}, seed, me));
    if (wing_)
      sensors_.push_back(std::make_unique<sensory::AirspeedSensor>(
          sensory::AirspeedOptions{}, seed, me));
    sense();
  }

  const VehicleState& truth() const { return world_.vehicle; }
  const autopilot::FlightEstimator& estimator() const { return estimator_; }

  void step(const Actuators& u) {
    const double height = -world_.vehicle.p_N.z();
    const Gust gust =
        turbulence_.advance({now_, world_.vehicle, height, case_.wind}, kStep);
    world_.air.wind_N = case_.wind + gust.velocity_N;
    world_.air.rates_B = gust.rates_B;
    plant_.step(world_.vehicle, u, world_.air, kStep);
    now_ += Time::from_seconds(kStep);
    sense();
  }

 private:
  autopilot::EstimatorOptions options() const {
    autopilot::EstimatorOptions o;
    o.fixed_wing = wing_;
    return o;
  }

  // As wrong as it says. What nobody knows is what SkeinAutopilot starts with.
  autopilot::EstimatorStart start_near(const VehicleState& truth) {
    const auto draw = [this](double sd) {
      const double x = normal_(), y = normal_(), z = normal_();
      return Vec3(sd * Vec3(x, y, z));
    };
    const double place = case_.nobody_knows ? 50 : 2;
    const double wind = case_.nobody_knows ? 5 : 2;
    autopilot::EstimatorStart start;
    start.sd = {place, place, 0.3, 0.02, 0.05, wind};
    start.p_N = truth.p_N + draw(place);
    start.v_N = truth.v_N + draw(0.3);
    const Vec3 tilt = draw(0.02);
    start.q_NB = geo::exp_so3(Vec3(tilt.x(), tilt.y(), tilt.z() * 2.5)) * truth.q_NB;
    start.wind_N = case_.wind.head<2>() + draw(wind).head<2>();
    return start;
  }

  void sense() {
    samples_.clear();
    for (const auto& sensor : sensors_) sensor->sample(world_.at(now_), samples_);
    for (const SensorSample& sample : samples_) estimator_.sense(sample);
  }

  const Case& case_;
  const Plant& plant_;
  bool wing_;
  environment::DrydenTurbulence turbulence_;
  FastNormals normal_;
  autopilot::FlightEstimator estimator_;
  sensory::TestWorld world_;
  std::vector<std::unique_ptr<Sensor>> sensors_;
  std::vector<SensorSample> samples_;
  Time now_;
};

// `steer(t, nav)` gives the control of the step in second t.
template <class Steer>
void fly(const Case& c, Aircraft& aircraft, Steer&& steer, Outcome& out) {
  Vec3 before_outage = Vec3::Zero();
  for (std::size_t t = 0; t < kSeconds; ++t) {
    for (int k = 0; k < 100; ++k) aircraft.step(steer(t, aircraft.estimator().state()));
    const VehicleState& s = aircraft.truth();
    const autopilot::NavState& nav = aircraft.estimator().state();
    out.lost = out.lost || !(s.p_N.z() < 0) || !(geo::down_in_body(s.q_NB).z() > 0);
    out.nees[t] += nees(s, aircraft.estimator()) / kRuns;
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

void fly_wing(const Case& c, std::uint64_t seed, Outcome& out) {
  const asset::FixedWingParameters parameters = asset::aerosonde();
  const asset::FixedWingPlant plant(parameters);
  const auto airframe = std::get<FixedWingAirframe>(plant.airframe());
  Aircraft aircraft(
      c, plant, plant.start({Vec3(0, 0, -150), 0.1 * static_cast<double>(seed), c.wind}),
      parameters.geometry.span, seed);
  autopilot::FixedWingControl control(airframe, {});
  autopilot::FixedWingDemand demand;
  demand.airspeed = airframe.cruise;
  fly(
      c, aircraft,
      [&](std::size_t t, const autopilot::NavState& nav) {
        const bool turns = t % 60 >= 20;
        demand.altitude_msl = 150;
        demand.lateral_acceleration = 0;
        if (c.manner == Manner::kTurns) {
          demand.lateral_acceleration = !turns ? 0 : t % 60 < 40 ? 4 : -4;
          demand.altitude_msl = t % 120 < 60 ? 150 : 180;
        } else if (c.manner == Manner::kOrbit) {
          demand.lateral_acceleration = kGravity * std::tan(geo::radians(30));
        }
        return control.control(demand, nav, kStep);
      },
      out);
}

// Hovers, then flies around a square of 30 m, 12 s for each side.
void fly_rotors(const Case& c, std::uint64_t seed, Outcome& out) {
  const asset::MultirotorPlant plant(asset::MultirotorParameters{});
  Aircraft aircraft(
      c, plant, plant.start({Vec3(0, 0, -150), 0.1 * static_cast<double>(seed), c.wind}),
      0.5, seed);
  autopilot::MultirotorControl control(std::get<MultirotorAirframe>(plant.airframe()),
                                       {});
  autopilot::MultirotorDemand demand;
  demand.altitude_msl = 150;
  constexpr std::array<std::array<double, 2>, 4> kCorners{
      {{0, 0}, {30, 0}, {30, 30}, {0, 30}}};
  fly(
      c, aircraft,
      [&](std::size_t t, const autopilot::NavState& nav) {
        const auto& corner = kCorners[t < 60 ? 0 : t / 12 % 4];
        demand.position = Vec2(corner[0], corner[1]);
        return control.control(demand, nav, kStep);
      },
      out);
}

using FlyOne = void (*)(const Case&, std::uint64_t, Outcome&);

Outcome fly(const Case& c, FlyOne fly_one = fly_wing) {
  Outcome out;
  for (std::uint64_t seed = 1; seed <= kRuns; ++seed) fly_one(c, seed, out);
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
  EXPECT_GT(inside, 0.8);
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

TEST(EstimatorFlight, IsConsistentFromAStartThatNobodyKnows) {
  expect_consistent(fly({.nobody_knows = true}));
}

TEST(EstimatorFlight, IsConsistentInStraightFlight) {
  expect_consistent(fly({.manner = Manner::kStraight, .nobody_knows = true}));
}

TEST(EstimatorFlight, IsConsistentInASteadyOrbit) {
  expect_consistent(fly({.manner = Manner::kOrbit, .nobody_knows = true}));
}

TEST(EstimatorFlight, IsConsistentWithADifferentialReceiver) {
  const Outcome out = fly({.outage = true, .kind = GnssKind::kDifferential});
  expect_consistent(out);
}

TEST(EstimatorFlight, IsConsistentWithPhaseFixes) {
  const Outcome out = fly({.outage = true, .kind = GnssKind::kRtk});
  expect_consistent(out);
}

TEST(EstimatorFlight, IsConsistentOnRotors) {
  expect_consistent(fly({.nobody_knows = true}, fly_rotors));
}

TEST(EstimatorFlight, IsConsistentOnRotorsInWindWithTurbulence) {
  expect_consistent(fly(
      {.wind = {4.8, 6.4, 0}, .wind_6m = kModerate, .nobody_knows = true}, fly_rotors));
}

}  // namespace
}  // namespace skein::estimator_flight_test
