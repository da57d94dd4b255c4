// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include <cmath>
#include <limits>
#include <type_traits>

#include "skein/layer/autopilot/estimator/test/synthetic_flight.h"

namespace skein::autopilot::flight_estimator_test {
namespace {

using testing::FlightPlan;
using testing::nees;
using testing::SyntheticFlight;

constexpr NavAccuracy kStart{2, 3, 0.3, 0.02, 0.05, 2};

struct Flown {
  SyntheticFlight flight;
  FlightEstimator estimator;

  explicit Flown(const FlightPlan& plan, const NavAccuracy& sd = kStart,
                 std::uint64_t seed = 5)
      : flight({}, plan, seed), estimator(EstimatorOptions{}, flight.start(sd)) {}

  void fly(int seconds) {
    for (int k = 0; k < 100 * seconds; ++k)
      flight.step([this](const auto& sample) { estimator.add(sample); });
  }
  ErrorVector error() const { return difference(flight.truth(), estimator.navigated()); }
  double miss(std::size_t first, std::size_t n) const {
    double sum = 0;
    for (std::size_t k = 0; k < n; ++k) sum += std::pow(error()[first + k], 2);
    return std::sqrt(sum);
  }
};

TEST(FlightEstimator, FindsTheHeadingFromThirtyDegreesOff) {
  NavAccuracy sd = kStart;
  sd.heading = geo::radians(30);
  for (double off : {-30.0, 30.0}) {
    FlightPlan plan;
    SyntheticFlight flight({}, plan, 3);
    EstimatorStart start = flight.start(sd);
    start.q_NB = geo::exp_so3({0, 0, geo::radians(off)}) * flight.truth().q_NB;
    FlightEstimator estimator(EstimatorOptions{}, start);
    for (int k = 0; k < 6000; ++k)
      flight.step([&](const auto& sample) { estimator.add(sample); });
    const ErrorVector e = difference(flight.truth(), estimator.navigated());
    EXPECT_LT(std::abs(e[error::kAttitude + 2]), 0.02) << off;
    EXPECT_LT(std::abs(e[error::kAttitude + 2]), 4 * estimator.accuracy().heading) << off;
  }
}

TEST(FlightEstimator, FindsTheHeadingThatItWasSureOf) {
  // Thirty degrees off, with a stated deviation of three: the gate must not shut it out.
  SyntheticFlight flight({}, {}, 3);
  EstimatorStart start = flight.start(kStart);
  start.q_NB = geo::exp_so3({0, 0, geo::radians(30)}) * flight.truth().q_NB;
  FlightEstimator estimator(EstimatorOptions{}, start);
  for (int k = 0; k < 9000; ++k)
    flight.step([&](const auto& sample) { estimator.add(sample); });
  EXPECT_LT(
      std::abs(difference(flight.truth(), estimator.navigated())[error::kAttitude + 2]),
      0.05);
}

TEST(FlightEstimator, LearnsTheBiases) {
  Flown f({});
  f.fly(180);
  // From 5e-3 rad/s and 0.1 m/s^2 per axis. Manoeuvres show them.
  EXPECT_LT(f.miss(error::kGyroBias, 3), 1e-3);
  EXPECT_LT(f.miss(error::kAccelBias, 3), 0.06);
  EXPECT_LT(f.estimator.covariance().variance(error::kGyroBias), 1e-6);
  EXPECT_LT(f.estimator.covariance().variance(error::kAccelBias), 0.04 * 0.04);
}

TEST(FlightEstimator, LearnsWindAndGusts) {
  FlightPlan calm;
  calm.wind = {5, -3};
  Flown still(calm);
  still.fly(200);
  EXPECT_LT(still.miss(error::kWind, 2),
            4 * std::sqrt(2) * still.estimator.accuracy().wind);
  EXPECT_LT(still.estimator.gust_sd(), 0.5);
  FlightPlan rough = calm;
  rough.gust_sd = 2;
  Flown gusty(rough);
  gusty.fly(200);
  EXPECT_NEAR(gusty.estimator.gust_sd(), 2, 0.8);  // 10 s gusts over 120 s
  EXPECT_GT(gusty.estimator.accuracy().wind, 1.3 * still.estimator.accuracy().wind);
}

TEST(FlightEstimator, DriftsLittleWithoutSatellitesAndSaysSo) {
  FlightPlan plan;
  plan.outage_from = 100;
  plan.outage_until = 130;
  Flown f(plan);
  f.fly(99);
  const Vec3 before = f.flight.truth().p_N - f.estimator.state().p_N;
  const double sd_before = f.estimator.accuracy().position;
  const NavEstimate told = f.estimator.estimate();
  EXPECT_EQ(told.position_sd, sd_before);
  EXPECT_GT(told.altitude_sd, 0);
  EXPECT_EQ(told.altitude_sd, f.estimator.accuracy().altitude);
  EXPECT_FALSE(f.estimator.gnss_lost());
  f.fly(30);
  const Vec3 after = f.flight.truth().p_N - f.estimator.state().p_N;
  EXPECT_TRUE(f.estimator.gnss_lost());
  EXPECT_NEAR(f.estimator.gnss_age(), 29, 1);
  // Some 0.1 m/s of velocity error after half a minute.
  EXPECT_LT((after - before).norm(), 10);
  EXPECT_GT(f.estimator.accuracy().position, sd_before + 0.3);
  f.fly(5);
  EXPECT_FALSE(f.estimator.gnss_lost());
}

TEST(FlightEstimator, FliesOnWithoutEachOfTheSensors) {
  for (int missing = 0; missing < 3; ++missing) {
    FlightPlan plan;
    plan.barometer = missing != 0;
    plan.magnetometer = missing != 1;
    plan.airspeed = missing != 2;
    Flown f(plan);
    f.fly(150);
    // 28 states, five standard deviations of chi-square above the mean.
    EXPECT_LT(nees(f.flight.truth(), f.estimator, 0, error::kSize), 28 + 5 * 7.5)
        << missing;
    EXPECT_LT(f.miss(error::kAttitude, 3), 0.06) << missing;
  }
}

TEST(FlightEstimator, StaysPositiveDefiniteForAnHour) {
  Flown f({});
  for (int part = 0; part < 12; ++part) {
    f.fly(300);
    const ErrorCovariance& p = f.estimator.covariance();
    Eigen::MatrixXd scaled(error::kSize, error::kSize);
    for (std::size_t i = 0; i < error::kSize; ++i)
      for (std::size_t j = 0; j < error::kSize; ++j)
        scaled(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
            p(i, j) / std::sqrt(p.variance(i) * p.variance(j));
    const double min =
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(scaled, Eigen::EigenvaluesOnly)
            .eigenvalues()[0];
    // Of the correlations: far above the rounding of 1e-16 per correction.
    EXPECT_GT(min, 1e-7) << part;
  }
}

TEST(FlightEstimator, DropsWhatIsNotANumber) {
  Flown f({}), g({});
  f.fly(20);
  g.fly(20);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Time now = f.flight.now();
  const Vec3 none(0, nan, 0);
  g.estimator.add(ImuSample{now + Time::from_ns(10'000'000), 0.01, none, Vec3::Zero()});
  g.estimator.add(ImuSample{now + Time::from_ns(10'000'000), 0.01, Vec3::Zero(), none});
  g.estimator.add(GnssFix{now, none, Vec3::Zero(), 2, 3, 0.1, GnssKind::kSingle});
  g.estimator.add(GnssFix{now, Vec3::Zero(), Vec3::Zero(), nan, 3, 0.1});
  g.estimator.add(BarometerSample{now, nan});
  g.estimator.add(MagnetometerSample{now, none});
  g.estimator.add(AirspeedSample{now, std::numeric_limits<double>::infinity()});
  g.estimator.add(AnemometerSample{now, none});
  g.estimator.add(HeightSample{now, nan});
  g.estimator.add(TruthSample{now, none});
  EXPECT_EQ(g.estimator.counts().bad, 10u);
  f.fly(5);
  g.fly(5);
  EXPECT_EQ(f.estimator.state().p_N, g.estimator.state().p_N);
}

TEST(FlightEstimator, NeverGoesBackInTime) {
  Flown f({});
  f.fly(20);
  const NavState before = f.estimator.state();
  f.estimator.add(ImuSample{before.time, 0.01, Vec3::Ones(), Vec3::Ones()});
  f.estimator.add(ImuSample{Time::from_seconds(1), 0.01, Vec3::Ones(), Vec3::Ones()});
  f.estimator.add(GnssFix{Time::from_seconds(3), Vec3::Zero(), Vec3::Zero(), 2, 3, 0.1});
  EXPECT_EQ(f.estimator.counts().late, 3u);
  EXPECT_EQ(f.estimator.state().p_N, before.p_N);
  EXPECT_EQ(f.estimator.state().time, before.time);
}

TEST(FlightEstimator, BridgesGapsOfInertialSamples) {
  for (int lost : {1, 5, 100}) {
    Flown f({});
    f.fly(60);
    const double sd = f.estimator.accuracy().velocity;
    int k = 0;
    for (; k < lost; ++k) f.flight.step([](const auto&) {});
    f.flight.step([&](const auto& sample) { f.estimator.add(sample); });
    EXPECT_EQ(f.estimator.counts().gaps, 1u);
    for (; k < 30; ++k)
      f.flight.step([&](const auto& sample) { f.estimator.add(sample); });
    if (lost == 100) {
      EXPECT_GT(f.estimator.accuracy().velocity, 2 * sd);
    }
    f.fly(30);
    EXPECT_LT(nees(f.flight.truth(), f.estimator, error::kAttitude, error::kSize),
              9 + 5 * 4.3)
        << lost;
  }
}

TEST(FlightEstimator, RejectsAWildFixButFollowsWhenItLasts) {
  Flown f({});
  f.fly(60);
  const Vec3 jump(300, 0, 0);
  const auto fly_displaced = [&](int steps) {
    for (int k = 0; k < steps; ++k)
      f.flight.step([&](auto sample) {
        if constexpr (requires { sample.position_sd; }) sample.p_N += jump;
        f.estimator.add(sample);
      });
  };
  fly_displaced(200);
  EXPECT_GT(f.estimator.counts().rejected, 0u);
  EXPECT_LT((f.flight.truth().p_N - f.estimator.state().p_N).norm(), 20);
  fly_displaced(500);  // rejected for more than gnss_reset_after
  EXPECT_EQ(f.estimator.counts().resets, 1u);
  EXPECT_LT((f.flight.truth().p_N + jump - f.estimator.state().p_N).norm(), 20);
}

TEST(FlightEstimator, TrustsAReceiverThatFixesItsPhase) {
  FlightPlan plan;
  Flown f(plan);
  const auto fly_rtk = [&](int steps) {
    for (int k = 0; k < steps; ++k)
      f.flight.step([&](auto sample) {
        if constexpr (requires { sample.position_sd; }) {
          // Without the errors of the code: straight from the truth, at its time.
          sample.p_N = f.flight.truth().p_N - 0.12 * f.flight.truth().v_N;
          sample.position_sd = 0.02;
          sample.altitude_sd = 0.03;
          sample.kind = GnssKind::kRtk;
        }
        f.estimator.add(sample);
      });
  };
  f.fly(60);
  EXPECT_GT(f.estimator.accuracy().position, 1);
  fly_rtk(1000);
  EXPECT_LT(f.estimator.accuracy().position, 0.1);
  EXPECT_LT(f.miss(error::kPosition, 3), 0.3);  // the turn within the latency
}

TEST(FlightEstimator, AlignsAtRest) {
  const EstimatorOptions options;
  FastNormals normal(RandomStream(1, 0, Purpose::kTest));
  const Quat q = geo::from_euler({0.1, 0.15, 2});
  const Vec3 gyro_bias(0.004, -0.006, 0.005);
  EstimatorStart start;
  start.at_rest = true;
  FlightEstimator estimator(options, start);
  EXPECT_TRUE(estimator.aligning());
  const auto noise = [&](double sd) {
    const double x = normal(), y = normal(), z = normal();
    return Vec3(sd * Vec3(x, y, z));
  };
  for (int k = 1; k <= 1000; ++k) {
    const Time now = Time::from_ns(k * 10'000'000LL);
    estimator.add(ImuSample{now, 0.01, gyro_bias + noise(2e-3),
                            q.conjugate() * Vec3(0, 0, -kGravity) + noise(0.04)});
    if (k % 20 == 0) estimator.add(GnssFix{now, noise(0.3), noise(0.05), 3.8, 8, 0.05});
    if (k % 4 == 0)
      estimator.add(MagnetometerSample{
          now, q.conjugate() * Vec3(std::cos(1.15), 0, std::sin(1.15)) + noise(0.005)});
    if (k % 4 == 0) estimator.add(AirspeedSample{now, 0});
  }
  EXPECT_FALSE(estimator.aligning());
  EXPECT_LT(geo::log_so3(q * estimator.state().q_NB.conjugate()).norm(), 0.01);
  EXPECT_LT((estimator.navigated().gyro_bias - gyro_bias).norm(), 1e-3);
  EXPECT_LT(estimator.state().v_N.norm(), 0.2);
  EXPECT_EQ(estimator.navigated().wind_N, Vec2::Zero());
}

// Attitude error after ten seconds on the ground, of which it is shaken for some.
double error_of_alignment(double shaken_until) {
  FastNormals normal(RandomStream(2, 0, Purpose::kTest));
  EstimatorStart start;
  start.at_rest = true;
  FlightEstimator estimator(EstimatorOptions{}, start);
  const Vec3 down(0, 0, -kGravity);
  Quat q = Quat::Identity();
  for (int k = 1; k <= 1000; ++k) {
    const double t = 0.01 * k;
    const bool shaken = t < shaken_until;
    // A gust rocks it about its forward axis.
    const double rate = shaken ? 1.2 * std::sin(3 * t) : 0;
    q = q * geo::exp_so3(Vec3(0.01 * rate, 0, 0));
    if (!shaken) q = Quat::Identity();
    const Vec3 push(shaken ? 2 : 0, 0, 0);
    estimator.add(ImuSample{Time::from_seconds(t), 0.01,
                            Vec3(rate, 0, 0) + 2e-3 * Vec3(normal(), normal(), normal()),
                            q.conjugate() * down + push});
  }
  EXPECT_FALSE(estimator.aligning());
  return std::acos(geo::down_in_body(estimator.state().q_NB).z());
}

TEST(FlightEstimator, WaitsForRestToFindItsAttitude) {
  EXPECT_LT(error_of_alignment(0), 0.002);
  EXPECT_LT(error_of_alignment(6.5), 0.002);
}

TEST(FlightEstimator, FindsAnAttitudeEvenIfItNeverRests) {
  EstimatorStart start;
  start.at_rest = true;
  FlightEstimator estimator(EstimatorOptions{}, start);
  for (int k = 1; k <= 2500; ++k)
    estimator.add(ImuSample{Time::from_seconds(0.01 * k),
                            0.01,
                            Vec3(0.3 * std::sin(0.1 * k), 0, 0),
                            {0, 0, -kGravity}});
  EXPECT_FALSE(estimator.aligning());
  EXPECT_GT(estimator.accuracy().tilt, 0.05) << "and knows that it is not good";
}

// Stands for five seconds, then rolls straight along its nose with 3 m/s^2, in a wind
// from anywhere; all sensors but the GNSS receiver with noise only.
class GroundRunInWind {
 public:
  GroundRunInWind(double heading, const Vec2& wind, std::uint64_t seed)
      : q_(geo::from_euler({0, 0.08, heading})),
        ahead_(geo::unit(heading)),
        wind_(wind),
        normal_(RandomStream(seed, 2, Purpose::kTest)) {}

  void roll(FlightEstimator& estimator) {
    for (int k = 1; k <= 900; ++k) {
      const Time now = Time::from_ns(k * 10'000'000LL);
      const double speed = std::max(0.0, 3 * (now.seconds() - 5));
      const Vec2 v = speed * ahead_;
      const Vec2 pull = speed > 0 ? Vec2(3 * ahead_) : Vec2(0, 0);
      estimator.add(
          ImuSample{now, 0.01, noise(2e-3),
                    q_.conjugate() * Vec3(pull.x(), pull.y(), -kGravity) + noise(0.04)});
      if (k % 20 == 0)
        estimator.add(GnssFix{now,
                              Vec3(0.5 * speed * speed / 3 * ahead_.x(),
                                   0.5 * speed * speed / 3 * ahead_.y(), 0) +
                                  noise(0.3),
                              Vec3(v.x(), v.y(), 0) + noise(0.05), 3.8, 8, 0.05});
      if (k % 4 != 0) continue;
      estimator.add(MagnetometerSample{
          now, q_.conjugate() * Vec3(std::cos(1.15), 0, std::sin(1.15)) + noise(0.005)});
      const double felt = (v - wind_).dot(ahead_) + 0.3 * normal_();
      estimator.add(AirspeedSample{now, felt < 3 ? 0 : felt});
    }
  }
  const Quat& attitude() const { return q_; }

 private:
  Vec3 noise(double sd) {
    const double x = normal_(), y = normal_(), z = normal_();
    return sd * Vec3(x, y, z);
  }

  Quat q_;
  Vec2 ahead_, wind_;
  FastNormals normal_;
};

TEST(FlightEstimator, KnowsItsAttitudeInATakeOffRunAcrossTheWind) {
  RandomStream random(31, 0, Purpose::kTest);
  for (int trial = 0; trial < 60; ++trial) {
    const double heading = random.uniform(-geo::kPi, geo::kPi);
    const Vec2 wind =
        random.uniform(0, 12) * geo::unit(random.uniform(-geo::kPi, geo::kPi));
    GroundRunInWind run(heading, wind, static_cast<std::uint64_t>(trial));
    EstimatorStart start;
    start.at_rest = true;
    start.sd.wind = 5;
    FlightEstimator estimator(EstimatorOptions{}, start);
    run.roll(estimator);
    const Vec3 wrong = geo::log_so3(run.attitude() * estimator.state().q_NB.conjugate());
    EXPECT_LT(wrong.head<2>().norm(), 0.02) << "tilt, in a wind of " << wind.transpose();
    EXPECT_LT(std::abs(wrong.z()), 0.06) << "heading, in a wind of " << wind.transpose();
    EXPECT_EQ(estimator.counts().alignments, 0u);
    // What blows across cannot be felt; what is believed of the wind keeps its word.
    const Vec2 miss = estimator.state().wind_N.head<2>() - wind;
    const double sd = estimator.accuracy().wind;
    EXPECT_LT(miss.norm(), 4 * std::sqrt(2.0) * sd) << wind.transpose();
  }
}

TEST(FlightEstimator, FindsAnAttitudeThatHasNothingToDoWithWhatItBelieved) {
  RandomStream random(32, 0, Purpose::kTest);
  for (int trial = 0; trial < 40; ++trial) {
    FlightPlan plan;
    plan.wind = random.uniform(0, 8) * geo::unit(random.uniform(-geo::kPi, geo::kPi));
    plan.gust_sd = random.uniform(0, 2);
    SyntheticFlight flight({}, plan, static_cast<std::uint64_t>(100 + trial));
    EstimatorStart start = flight.start(kStart);
    const Vec3 off(random.uniform(-1.5, 1.5), random.uniform(-1.5, 1.5),
                   random.uniform(-geo::kPi, geo::kPi));
    start.q_NB = geo::exp_so3(off) * flight.truth().q_NB;
    FlightEstimator estimator(EstimatorOptions{}, start);
    for (int k = 0; k < 3000; ++k)
      flight.step([&](const auto& sample) { estimator.add(sample); });
    const ErrorVector e = difference(flight.truth(), estimator.navigated());
    EXPECT_LT(std::hypot(e[error::kAttitude], e[error::kAttitude + 1]), 0.05)
        << off.transpose();
    EXPECT_LT(std::abs(e[error::kAttitude + 2]), 0.15) << off.transpose();
    EXPECT_FALSE(estimator.diverged());
  }
}

TEST(FlightEstimator, StaysHealthyInAGoodFlight) {
  RandomStream random(33, 0, Purpose::kTest);
  for (int trial = 0; trial < 40; ++trial) {
    FlightPlan plan;
    plan.manoeuvres = random.uniform() < 0.7;
    plan.wind = random.uniform(0, 10) * geo::unit(random.uniform(-geo::kPi, geo::kPi));
    plan.gust_sd = random.uniform(0, 3);
    plan.outage_from = random.uniform(20, 100);
    plan.outage_until = plan.outage_from + random.uniform(0, 30);
    plan.airspeed = random.uniform() < 0.8;
    plan.magnetometer = random.uniform() < 0.8;
    Flown f(plan, kStart, static_cast<std::uint64_t>(trial));
    f.fly(150);
    EXPECT_EQ(f.estimator.counts().alignments, 0u) << trial;
  }
}

TEST(FlightEstimator, FindsItsAttitudeAfterAGapInTheInertialSamples) {
  RandomStream random(34, 0, Purpose::kTest);
  for (int trial = 0; trial < 30; ++trial) {
    const double from = random.uniform(20, 60), until = from + random.uniform(1, 15);
    SyntheticFlight flight({}, {}, static_cast<std::uint64_t>(trial));
    FlightEstimator estimator(EstimatorOptions{}, flight.start(kStart));
    for (int k = 0; k < static_cast<int>(100 * (until + 20)); ++k)
      flight.step([&](const auto& sample) {
        const double now = flight.now().seconds();
        if (std::is_same_v<std::decay_t<decltype(sample)>, ImuSample> && now > from &&
            now < until)
          return;
        estimator.add(sample);
      });
    const ErrorVector e = difference(flight.truth(), estimator.navigated());
    EXPECT_LT(std::hypot(e[error::kAttitude], e[error::kAttitude + 1]), 0.05)
        << from << " to " << until;
  }
}

TEST(FlightEstimator, TakesTheTruthAsItIs) {
  SyntheticFlight flight({}, {}, 1);
  FlightEstimator estimator(EstimatorOptions{}, flight.start(kStart));
  const TruthSample truth{
      Time::from_seconds(3), {1, 2, -30}, {4, 5, 6}, geo::from_euler({0.1, 0.2, 0.3}),
      {0.1, 0, 0},           {1, 2, 0}};
  estimator.sense(truth);
  flight.step([&](const auto& sample) { estimator.sense(sample); });
  EXPECT_TRUE(estimator.direct());
  EXPECT_EQ(estimator.state().p_N, truth.p_N);
  EXPECT_EQ(estimator.state().v_N, truth.v_N);
  EXPECT_EQ(estimator.state().q_NB.coeffs(), truth.q_NB.coeffs());
  EXPECT_EQ(estimator.state().wind_N, truth.wind_N);
  EXPECT_DOUBLE_EQ(estimator.state().airspeed, std::sqrt(9.0 + 9 + 36));
  EXPECT_EQ(estimator.accuracy().position, 0);
  EXPECT_EQ(estimator.gnss_age(), 0);
  EXPECT_NEAR(estimator.estimate().roll, 0.1, 1e-12);
}

TEST(FlightEstimator, KnowsTheWindFromAnAnemometerWithoutAirspeed) {
  EstimatorOptions options;
  options.fixed_wing = false;
  FlightPlan plan;
  plan.wind = {6, -2};
  plan.airspeed = false;
  SyntheticFlight flight(options, plan, 2);
  FlightEstimator with(options, flight.start(kStart)), without = with;
  for (int k = 0; k < 6000; ++k) {
    flight.step([&](const auto& sample) {
      with.add(sample);
      without.add(sample);
    });
    const Navigated& x = flight.truth();
    const Vec3 air = x.v_N - Vec3(x.wind_N.x(), x.wind_N.y(), 0);
    if (k % 10 == 0) with.add(AnemometerSample{flight.now(), x.q_NB.conjugate() * air});
  }
  EXPECT_LT((with.state().wind_N.head<2>() - flight.truth().wind_N).norm(), 0.6);
  EXPECT_GT(without.accuracy().wind, 1.9) << "nothing else shows it";
}

TEST(FlightEstimator, CarriesTheHeightOnAndForgetsIt) {
  SyntheticFlight flight({}, {}, 1);
  EstimatorStart start = flight.start(kStart);
  start.v_N.z() = -2;
  FlightEstimator estimator(EstimatorOptions{}, start);
  EXPECT_FALSE(estimator.height_agl());
  estimator.add(HeightSample{start.time - Time::from_seconds(0.5), 10});
  EXPECT_DOUBLE_EQ(estimator.height_agl().value(), 11);
  estimator.add(HeightSample{start.time - Time::from_seconds(1.5), 10});
  EXPECT_FALSE(estimator.height_agl());
}

TEST(FlightEstimator, IsSmall) {
  // Ten thousand of them in 56 MB.
  EXPECT_LE(sizeof(FlightEstimator), 5600u);
}

}  // namespace
}  // namespace skein::autopilot::flight_estimator_test
