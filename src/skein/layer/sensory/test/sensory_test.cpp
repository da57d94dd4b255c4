// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "skein/layer/sensory/air_data_sensor.h"
#include "skein/layer/sensory/edge_finder.h"
#include "skein/layer/sensory/fire_sensor.h"
#include "skein/layer/sensory/gnss_sensor.h"

namespace skein::sensory::sensory_test {
namespace {

class FlatGround final : public Terrain {
 public:
  double elevation_msl(const Vec2&) const override { return 100; }
  Vec2 gradient(const Vec2&) const override { return Vec2::Zero(); }
};

// Burning: a 200 m square around the origin with a 20 m hole in it.
class SquareFire final : public Phenomenon {
 public:
  void advance(Time) override {}
  bool inside(const Vec2& p) const override { return geo::contains(region_, p); }
  const geo::Region& region() const override { return region_; }

 private:
  geo::Region region_{{{-100, -100}, {100, -100}, {100, 100}, {-100, 100}},
                      {{-10, -10}, {-10, 10}, {10, 10}, {10, -10}}};
};

struct World {
  FlatGround ground;
  SquareFire fire;
  const Phenomenon* phenomena[1] = {&fire};
  VehicleState vehicle;
  Air air;

  SensorView at(Time now) const { return {now, vehicle, air, ground, phenomena}; }
  std::vector<SensorSample> run(Sensor& sensor, Time tick, int ticks) const {
    std::vector<SensorSample> out;
    for (int i = 0; i < ticks; ++i) sensor.sample(at(tick * i), out);
    return out;
  }
};

Time ms(int n) {
  return Time::from_ns(n * 1'000'000LL);
}

TEST(SampleClock, TicksAtMultiplesOfThePeriod) {
  SampleClock clock(2);
  int count = 0;
  for (int i = 0; i <= 100; ++i) {
    if (!clock.due(ms(20 * i))) continue;
    EXPECT_EQ(20 * i % 500, 0);
    ++count;
  }
  EXPECT_EQ(count, 5);  // 0, 0.5, 1, 1.5, 2 s
}

TEST(SampleClock, UnevenTicksLoseNoSample) {
  SampleClock clock(3);
  int count = 0;
  for (int i = 0; i < 1000; ++i) count += clock.due(ms(70 * i)) ? 1 : 0;
  EXPECT_EQ(count, 210);  // 70 s at 3 Hz
}

TEST(GnssSensor, PerfectOneSeesTheTruth) {
  World world;
  world.vehicle.p_N = {1, 2, -300};
  world.vehicle.v_N = {3, 4, 5};
  GnssSensor sensor({.position_sd = 0, .altitude_sd = 0, .velocity_sd = 0}, 1, {1});
  const auto out = world.run(sensor, ms(100), 11);
  ASSERT_EQ(out.size(), 6U);
  const auto& fix = std::get<GnssFix>(out[5]);
  EXPECT_EQ(fix.time, ms(1000));
  EXPECT_EQ(fix.p_N, world.vehicle.p_N);
  EXPECT_EQ(fix.v_N, world.vehicle.v_N);
  EXPECT_EQ(fix.position_sd, 0);
}

TEST(GnssSensor, ErrorHasTheStatedSpreadAndCorrelation) {
  const World world;
  GnssSensor sensor({.rate_hz = 1, .position_sd = 3, .correlation_time = 10}, 7, {4});
  const int n = 200000;
  const auto out = world.run(sensor, ms(1000), n);
  double sum = 0, sum2 = 0, lag10 = 0;
  for (std::size_t i = 0; i < out.size(); ++i) {
    const double e = std::get<GnssFix>(out[i]).p_N.x();
    sum += e;
    sum2 += e * e;
    if (i >= 10) lag10 += e * std::get<GnssFix>(out[i - 10]).p_N.x();
  }
  // n / (2 * 10) independent samples: 1 % relative sd of the mean and of the variance.
  EXPECT_NEAR(sum / n, 0, 3 * 3 * 0.01);
  EXPECT_NEAR(sum2 / n, 9, 9 * 0.06);
  EXPECT_NEAR(lag10 / sum2, std::exp(-1.0), 0.06);
}

TEST(GnssSensor, SameSeedSameErrorsOtherEntityOthers) {
  const World world;
  GnssSensor a({}, 1, {1}), b({}, 1, {1}), c({}, 1, {2});
  const auto first = world.run(a, ms(200), 20);
  const auto again = world.run(b, ms(200), 20);
  const auto other = world.run(c, ms(200), 20);
  for (std::size_t i = 0; i < first.size(); ++i) {
    EXPECT_EQ(std::get<GnssFix>(first[i]).p_N, std::get<GnssFix>(again[i]).p_N);
    EXPECT_NE(std::get<GnssFix>(first[i]).p_N, std::get<GnssFix>(other[i]).p_N);
  }
}

TEST(AirDataSensor, AddsWhiteErrors) {
  World world;
  world.vehicle.airspeed = 20;
  world.vehicle.q_NB = geo::from_euler({0, 0, 3});
  AirDataSensor perfect({}, 1, {1});
  const auto truth = world.run(perfect, ms(50), 1);
  EXPECT_EQ(std::get<AirDataSample>(truth.at(0)).airspeed, 20);
  EXPECT_NEAR(std::get<AirDataSample>(truth.at(0)).heading, 3, 1e-15);
  AirDataSensor noisy({.rate_hz = 20, .airspeed_sd = 0.5, .heading_sd = 0.02}, 1, {1});
  double speed2 = 0, heading2 = 0;
  const int n = 20000;
  for (const auto& s : world.run(noisy, ms(50), n)) {
    const auto& air = std::get<AirDataSample>(s);
    speed2 += std::pow(air.airspeed - 20, 2);
    heading2 += std::pow(geo::wrap_pi(air.heading - 3), 2);
  }
  EXPECT_NEAR(std::sqrt(speed2 / n), 0.5, 0.5 * 0.02);  // 4 sigma of a spread of n
  EXPECT_NEAR(std::sqrt(heading2 / n), 0.02, 0.02 * 0.02);
}

TEST(FireSensor, LooksAtItsPoint) {
  World world;
  world.vehicle.p_N = {-150, 0, -200};
  FireSensor below({}, 1, {1});
  FireSensor ahead({.look_ahead = 60}, 1, {1});
  EXPECT_FALSE(std::get<FireSample>(world.run(below, ms(1000), 1).at(0)).inside);
  const auto sample = std::get<FireSample>(world.run(ahead, ms(1000), 1).at(0));
  EXPECT_TRUE(sample.inside);
  EXPECT_EQ(sample.look_ahead, 60);
}

TEST(FireSensor, IsBlindAboveItsHeight) {
  World world;
  world.vehicle.p_N = {0, 0, -350};  // 250 m above ground
  FireSensor low({.max_height = 249}, 1, {1}), high({.max_height = 251}, 1, {1});
  EXPECT_TRUE(world.run(low, ms(1000), 3).empty());
  EXPECT_EQ(world.run(high, ms(1000), 3).size(), 3U);
}

TEST(FireSensor, ErrsAsOftenAsStated) {
  World world;
  const int n = 20000;
  const auto share_inside = [&](const Vec2& p) {
    world.vehicle.p_N = {p.x(), p.y(), -150};
    FireSensor sensor({.false_in = 0.1, .false_out = 0.3}, 5, {2});
    int inside = 0;
    for (const auto& s : world.run(sensor, ms(1000), n))
      inside += std::get<FireSample>(s).inside ? 1 : 0;
    return static_cast<double>(inside) / n;
  };
  EXPECT_NEAR(share_inside({500, 0}), 0.1, 0.01);  // above 4 sigma = 0.0085
  EXPECT_NEAR(share_inside({50, 0}), 0.7, 0.014);  // 4 sigma = 0.013
}

TEST(EdgeFinder, SeesTheNearestEdgeWithTheFireOnItsRight) {
  World world;
  EdgeFinder sensor(EdgeFinderOptions{});
  world.vehicle.p_N = {130, 20, -150};  // north of the square
  std::vector<SensorSample> out;
  sensor.sample(world.at(ms(0)), out);
  const auto edge = std::get<EdgeSample>(out.at(0));
  EXPECT_LT((edge.offset - Vec2(-30, 0)).norm(), 1e-12);
  EXPECT_LT((edge.tangent - Vec2(0, 1)).norm(), 1e-12);
  world.vehicle.p_N = {6, 0, -150};  // in the hole
  sensor.sample(world.at(ms(1000)), out);
  const auto hole = std::get<EdgeSample>(out.at(1));
  EXPECT_LT((hole.offset - Vec2(4, 0)).norm(), 1e-12);
  EXPECT_LT((hole.tangent - Vec2(0, -1)).norm(), 1e-12);
}

TEST(EdgeFinder, SeesNothingOutOfRange) {
  World world;
  EdgeFinder sensor({.range = 50});
  world.vehicle.p_N = {151, 0, -150};
  EXPECT_TRUE(world.run(sensor, ms(1000), 2).empty());
}

TEST(Sensors, TwoOfOneKindHaveErrorsOfTheirOwn) {
  World world;
  world.vehicle.p_N = {0, 500, -200};  // outside
  FireSensorOptions options;
  options.false_in = 0.3;
  const auto readings = [&](std::uint32_t instance) {
    FireSensor sensor(options, 1, EntityId{4}, instance);
    std::vector<bool> inside;
    for (const SensorSample& sample : world.run(sensor, ms(1000), 1000))
      inside.push_back(std::get<FireSample>(sample).inside);
    return inside;
  };
  const auto first = readings(0), second = readings(1);
  ASSERT_EQ(first.size(), 1000u);
  int both = 0, equal = 0;
  for (std::size_t i = 0; i < 1000; ++i) {
    both += first[i] && second[i] ? 1 : 0;
    equal += first[i] == second[i] ? 1 : 0;
  }
  // Independent: 90 +- 9 wrong in both, 580 +- 16 equal; five standard deviations.
  EXPECT_NEAR(both, 90, 45);
  EXPECT_NEAR(equal, 580, 80);
}

}  // namespace
}  // namespace skein::sensory::sensory_test
