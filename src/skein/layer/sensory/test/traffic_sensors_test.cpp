// SPDX-License-Identifier: Apache-2.0
// Sensors that find other aircraft.
#include <gtest/gtest.h>

#include <cmath>

#include "skein/layer/sensory/passive_detector.h"
#include "skein/layer/sensory/test/test_world.h"
#include "skein/layer/sensory/traffic_radar.h"
#include "skein/layer/sensory/traffic_receiver.h"

namespace skein::sensory::traffic_sensors_test {
namespace {

constexpr Transmitters kAll{true, true, true};
constexpr EntityId kSelf{3};

// The vehicle at the origin, 200 m up, nose to the east; one other aircraft.
TestWorld with(const Vec3& p_N, Transmitters sends = kAll) {
  TestWorld world;
  world.vehicle.p_N = {0, 0, -200};
  world.vehicle.q_NB = geo::from_euler({0, 0, geo::kPi / 2});
  world.aircraft.push_back({p_N, {30, -10, 2}, 77, sends, {}});
  return world;
}

TEST(TrafficReceiver, HearsThoseThatSendWithTheirErrors) {
  TrafficReceiver sensor({}, 1, kSelf);
  const auto heard =
      only<TrafficBroadcast>(with({5000, 3000, -500}).run(sensor, ms(100), 40000));
  // 4000 broadcasts, of which 95 % are received: three standard deviations are 41.
  EXPECT_NEAR(static_cast<double>(heard.size()), 3800, 45);
  std::vector<double> north, up, east_speed;
  for (const TrafficBroadcast& each : heard) {
    EXPECT_EQ(each.address, 77u);
    EXPECT_EQ(each.position_sd, heard.front().position_sd) << "of one sender the same";
    north.push_back(each.p_N.x() - 5000);
    up.push_back(each.p_N.z() + 500);
    east_speed.push_back(each.v_N.y() + 10);
  }
  const double sd = heard.front().position_sd;
  EXPECT_GE(sd, 10);
  EXPECT_LE(sd, 30);
  // Standard deviations of samples are off by 1.1 %, means by 1.6 % of them.
  EXPECT_NEAR(std::sqrt(moments(north).variance), sd, 0.05 * sd);
  EXPECT_NEAR(moments(north).mean, 0, 0.06 * sd);
  EXPECT_NEAR(std::sqrt(moments(up).variance), 8, 0.4);
  EXPECT_NEAR(std::sqrt(moments(east_speed).variance), 0.7, 0.035);
}

TEST(TrafficReceiver, HearsNeitherItselfNorSilentOnesNorFarOnes) {
  TrafficReceiverOptions options;
  options.reception = 1;
  TestWorld world = with({1000, 0, -200}, {false, true, true});    // no ADS-B
  world.aircraft.push_back({{50000, 0, -200}, {}, 78, kAll, {}});  // too far
  world.aircraft.push_back({world.vehicle.p_N, {}, 4, kAll, kSelf});
  TrafficReceiver ads_b(options, 1, kSelf);
  EXPECT_TRUE(world.run(ads_b, ms(100), 100).empty());
  options.hears = Transmitter::kFlarm;
  options.range = 5000;
  TrafficReceiver flarm(options, 1, kSelf);
  const auto heard = only<TrafficBroadcast>(world.run(flarm, ms(100), 100));
  ASSERT_EQ(heard.size(), 10u);
  EXPECT_EQ(heard.front().by, Transmitter::kFlarm);
  // One of the own team is heard like any other.
  world.aircraft.push_back({{500, 0, -200}, {}, 9, kAll, EntityId{8}});
  EXPECT_EQ(only<TrafficBroadcast>(world.run(flarm, ms(100), 200)).back().address, 9u);
}

TEST(TrafficRadar, MeasuresFromTheNoseWithinItsFieldOfView) {
  TrafficRadarOptions options;
  options.detection = 1;
  TrafficRadar sensor(options, 1, kSelf);
  // 2000 m ahead, 500 m to the left (north), 300 m above.
  const auto plots = only<RadarPlot>(with({500, 2000, -500}).run(sensor, ms(100), 20000));
  ASSERT_EQ(plots.size(), 2000u);
  std::vector<double> range, bearing, elevation;
  for (const RadarPlot& plot : plots) {
    range.push_back(plot.range);
    bearing.push_back(plot.bearing);
    elevation.push_back(plot.elevation);
  }
  const double distance = Vec3(500, 2000, 300).norm(), sd = geo::radians(1.5);
  // Means of 2000 are off by 2.2 % of the deviation, deviations by 1.6 %.
  EXPECT_NEAR(moments(range).mean, distance, 1);
  EXPECT_NEAR(std::sqrt(moments(range).variance), 10, 0.7);
  EXPECT_NEAR(moments(bearing).mean, math::atan2(-500, 2000), 0.1 * sd);
  EXPECT_NEAR(std::sqrt(moments(bearing).variance), sd, 0.07 * sd);
  EXPECT_NEAR(moments(elevation).mean, math::asin(300 / distance), 0.1 * sd);

  for (const Vec3& outside : {Vec3(0, -1000, -200), Vec3(2000, 500, -200),
                              Vec3(0, 500, -1200), Vec3(0, 3100, -200)})
    EXPECT_TRUE(with(outside).run(sensor, ms(100), 20000).empty()) << outside;
  // It needs nothing on board of the other.
  EXPECT_FALSE(with({0, 1000, -200}, {}).run(sensor, ms(100), 40000).empty());
}

TEST(PassiveDetector, IsCoarseAndNeedsATransponder) {
  PassiveDetectorOptions options;
  options.detection = 1;
  PassiveDetector sensor(options, 1, kSelf);
  const auto contacts =
      only<TransponderContact>(with({0, 4000, -350}).run(sensor, ms(100), 20000));
  ASSERT_GE(contacts.size(), 1990u);
  std::vector<double> factor, bearing, height;
  int without = 0;
  for (const TransponderContact& each : contacts) {
    factor.push_back(math::log(each.range / 4000));
    bearing.push_back(each.bearing);
    if (each.height) height.push_back(*each.height);
    without += each.height ? 0 : 1;
    EXPECT_NEAR(each.range_sd, 0.2 * each.range, 1e-9);
  }
  EXPECT_NEAR(moments(factor).mean, 0, 0.02);
  EXPECT_NEAR(std::sqrt(moments(factor).variance), 0.2, 0.015);
  EXPECT_NEAR(std::sqrt(moments(bearing).variance), geo::radians(20), geo::radians(1.5));
  EXPECT_NEAR(moments(height).mean, 150, 6);
  EXPECT_NEAR(std::sqrt(moments(height).variance), 60, 5);
  // A fifth of 2000 have none; three standard deviations are 54.
  EXPECT_NEAR(without, 400, 54);
  PassiveDetector other(options, 1, kSelf);
  EXPECT_TRUE(
      with({0, 4000, -350}, {true, true, false}).run(other, ms(100), 100).empty());
}

}  // namespace
}  // namespace skein::sensory::traffic_sensors_test
