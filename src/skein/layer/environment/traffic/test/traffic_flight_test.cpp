// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>

#include "skein/layer/environment/traffic/circuit_flight.h"
#include "skein/layer/environment/traffic/intruder_flight.h"
#include "skein/layer/environment/traffic/recorded_flight.h"
#include "skein/layer/environment/traffic/straight_flight.h"
#include "skein/layer/environment/traffic/wandering_flight.h"

namespace skein::environment::traffic_flight_test {
namespace {

Time s(double seconds) {
  return Time::from_seconds(seconds);
}

TrafficState at(TrafficAircraft& aircraft, double seconds) {
  aircraft.advance({s(seconds), {}});
  return aircraft.state();
}

// Of the motion between 0 and `seconds`, by differences of places.
struct Extremes {
  double turn_rate = 0, climb = 0, sink = 0, speed_low = 1e9, speed_high = 0;
  double lowest = 1e9, highest = -1e9, away = 0;
};
Extremes extremes(TrafficAircraft& aircraft, double seconds, double step) {
  Extremes out;
  const Vec2 home = geo::horizontal(at(aircraft, 0).p_N);
  Vec3 last = at(aircraft, 0).p_N, velocity = Vec3::Zero();
  for (double t = step; t <= seconds; t += step) {
    const Vec3 place = at(aircraft, t).p_N;
    const Vec3 now = (place - last) / step;
    const Vec2 level = geo::horizontal(now);
    if (t > step)
      out.turn_rate = std::fmax(
          out.turn_rate, std::abs(geo::wrap_pi(geo::bearing(level) -
                                               geo::bearing(geo::horizontal(velocity)))) /
                             step);
    out.climb = std::fmax(out.climb, -now.z());
    out.sink = std::fmax(out.sink, now.z());
    out.speed_low = std::fmin(out.speed_low, level.norm());
    out.speed_high = std::fmax(out.speed_high, level.norm());
    out.lowest = std::fmin(out.lowest, -place.z());
    out.highest = std::fmax(out.highest, -place.z());
    out.away = std::fmax(out.away, (geo::horizontal(place) - home).norm());
    last = place;
    velocity = now;
  }
  return out;
}

TEST(StraightFlight, TurnsAndClimbsWhenItIsToAndKeepsBoth) {
  StraightFlightOptions options;
  options.speed = 40;
  options.course = 0;
  options.asides = {{10, 9, geo::radians(10), 2.0}, {30, 9, geo::radians(-10), {}}};
  StraightFlight flight({100, 0, -300}, options);
  EXPECT_LT((at(flight, 10).p_N - Vec3(500, 0, -300)).norm(), 1e-9);
  // A quarter turn to the right with a radius of 40 / (10 deg/s).
  const double radius = 40 / geo::radians(10);
  EXPECT_LT((at(flight, 19).p_N - Vec3(500 + radius, radius, -318)).norm(), 1e-9);
  EXPECT_LT((flight.state().v_N - Vec3(0, 40, -2)).norm(), 1e-9);
  EXPECT_LT((at(flight, 39).v_N - Vec3(40, 0, -2)).norm(), 1e-9);
  EXPECT_NEAR(at(flight, 60).p_N.z(), -400, 1e-9);
}

// The intruders of the reference data meet an aircraft that flies straight on as its
// columns say.
TEST(StraightFlight, FliesTheReferenceEncounters) {
  const auto file =
      std::filesystem::path(SKEIN_SHARED_DATA) / "team/encounters/encounters.csv";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "without ../shared/data/team";
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  int cases = 0;
  while (std::getline(in, line)) {
    std::vector<double> cell;
    std::stringstream cells(line);
    std::string text;
    std::getline(cells, text, ',');
    const std::string name = text;
    while (std::getline(cells, text, ','))
      cell.push_back(text.empty() ? -1 : std::stod(text));
    const Vec3 own(cell[0], cell[1], cell[2]);
    const Vec2 ahead = Vec2(cell[3], cell[4]).normalized();
    const double own_speed = cell[5];
    const Vec2 velocity(cell[9], cell[10]);
    StraightFlightOptions options;
    options.speed = velocity.norm();
    options.course = geo::bearing(velocity);
    options.climb = -cell[11];
    if (cell[12] >= 0) options.asides = {{cell[12], cell[13], cell[14], -cell[15]}};
    StraightFlight intruder({cell[6], cell[7], cell[8]}, options);
    bool nmac = false, lowc = false;
    double nearest = std::numeric_limits<double>::infinity();
    for (double t = 0; t <= Vec2(cell[3], cell[4]).norm() / own_speed; t += 0.02) {
      const Vec3 apart =
          at(intruder, t).p_N - own - own_speed * t * Vec3(ahead.x(), ahead.y(), 0);
      const double h = geo::horizontal(apart).norm(), z = std::abs(apart.z());
      nearest = std::fmin(nearest, h);
      nmac |= h <= 152.4 && z <= 30.48;
      lowc |= h <= 609.6 && z <= 76.2;
    }
    EXPECT_EQ(nmac, cell[18] == 1) << name;
    EXPECT_EQ(lowc, cell[19] == 1) << name;
    // Of the place where both ratios together are least; never nearer than the nearest.
    EXPECT_GT(cell[16], nearest - 4) << name;
    ++cases;
  }
  EXPECT_GE(cases, 300);
}

TEST(CircuitFlight, TouchesDownWhereItBeganAndKeepsToItsHeight) {
  CircuitOptions options;
  options.height = 250;
  const Vec3 begin(500, -200, -120);
  CircuitFlight flight(begin, options);
  const Extremes e = extremes(flight, 800, 0.1);
  EXPECT_NEAR(e.lowest, 120, 1);
  EXPECT_NEAR(e.highest, 370, 1e-6);
  EXPECT_NEAR(e.speed_high, 35, 1e-3);
  EXPECT_NEAR(e.turn_rate, 35.0 / 250, 1e-3);
  EXPECT_LE(e.climb, 4 + 1e-6);
  EXPECT_LE(e.sink, 3 + 1e-6);
  // One time around: two legs of 1500 m and two of 500 m, and a full turn.
  const double around = (2 * 1500 + 2 * 500 + 2 * geo::kPi * 250) / 35;
  CircuitFlight again(begin, options);
  EXPECT_LT((at(again, around).p_N - begin).norm(), 0.1);
  // To the left of the runway, which leads north.
  CircuitFlight left(begin, options);
  EXPECT_LT(at(left, around / 2).p_N.y(), -200 - 900);
}

TEST(CircuitFlight, IsARacetrackWithoutAHeightAndSaysWhatCannotBeFlown) {
  CircuitOptions options;
  options.side = CircuitSide::kRight;
  options.width = 500;
  options.turn_radius = 250;
  CircuitFlight flight({0, 0, -300}, options);
  const Extremes e = extremes(flight, 400, 0.1);
  EXPECT_EQ(e.climb, 0);
  EXPECT_EQ(e.sink, 0);
  EXPECT_LE(circuit_lacks(options), 0);
  options.height = 2000;
  EXPECT_GT(circuit_lacks(options), 0);
}

TEST(WanderingFlight, StaysWithinItsLimitsWhateverTheStep) {
  WanderingOptions options;
  options.mean_leg = 30;
  for (std::uint32_t k = 0; k < 20; ++k) {
    WanderingFlight flight({1000, 2000, -300}, options, 5, k), coarse = flight;
    const Extremes e = extremes(flight, 900, 0.5);
    EXPECT_LE(e.turn_rate, options.limits.turn_rate * 1.001);
    EXPECT_GT(e.turn_rate, geo::radians(1)) << "it turns";
    EXPECT_LE(e.climb, options.limits.climb + 1e-9);
    EXPECT_LE(e.sink, options.limits.climb + 1e-9);
    EXPECT_GE(e.speed_low, options.slowest - 1e-6);
    EXPECT_LE(e.speed_high, options.fastest + 1e-6);
    EXPECT_GE(e.lowest, options.lowest - 1);
    EXPECT_LE(e.highest, options.highest + 1);
    // It may be carried past a waypoint at the rim by a turn.
    EXPECT_LE(e.away, options.radius + 2 * options.fastest / options.limits.turn_rate);
    for (double t = 0; t <= 900; t += 7.3) at(coarse, t);
    EXPECT_EQ(at(coarse, 900).p_N, at(flight, 900).p_N);
  }
  WanderingFlight one({0, 0, -300}, options, 5, 1), same({0, 0, -300}, options, 5, 1),
      other({0, 0, -300}, options, 6, 1);
  EXPECT_EQ(at(one, 100).p_N, at(same, 100).p_N);
  EXPECT_NE(at(one, 100).p_N, at(other, 100).p_N);
}

TEST(IntruderFlight, MeetsWhomItFollowsAndThenStaysBehind) {
  for (const double distance : {0.0, 150.0}) {
    IntruderOptions options;
    options.distance = distance;
    IntruderFlight flight({3000, 1000, -150}, options, EntityId{4});
    double nearest = 1e9, last = 0;
    for (int i = 0; i <= 6000; ++i) {
      const double t = 0.1 * i;
      const NoticedAircraft others[] = {{EntityId{3}, {9000, 0, -100}, {0, 0, 0}},
                                        {EntityId{4}, {20 * t, 0, -200}, {20, 0, 0}}};
      flight.advance({s(t), others});
      const Vec3 apart = others[1].p_N - flight.state().p_N;
      last = apart.x();
      if (t < 400) continue;
      nearest = std::fmin(nearest, apart.norm());
      EXPECT_NEAR(flight.state().p_N.z(), -200, 1);
    }
    if (distance == 0) {
      EXPECT_LT(nearest, 30);
    } else {
      EXPECT_NEAR(last, distance, 30);
    }
  }
}

TEST(IntruderFlight, FliesStraightOnWhenNobodyIsThere) {
  IntruderOptions options;
  IntruderFlight flight({0, 0, -150}, options, EntityId{4});
  EXPECT_LT((at(flight, 100).p_N - Vec3(1500, 0, -150)).norm(), 1e-6);
}

TEST(RecordedFlight, NamesGapsAndJumpsAndIsThereOnlyWhenItWasRecorded) {
  std::vector<RecordedPlace> places;
  for (int t = 10; t <= 30; ++t) places.push_back({1.0 * t, {40.0 * t, 0, -300}});
  for (int t = 31; t <= 50; ++t) places.push_back({1.0 * t, {40.0 * t, 1000, -300}});
  for (int t = 100; t <= 110; ++t) places.push_back({1.0 * t, {40.0 * t, 1000, -300}});
  RecordedFlight flight(places, {});
  EXPECT_EQ(flight.faults().jumps, 1);
  EXPECT_EQ(flight.faults().gaps, 1);
  EXPECT_EQ(at(flight, 0).phase, TrafficPhase::kAbsent);
  EXPECT_EQ(at(flight, 9.9).phase, TrafficPhase::kAbsent);
  EXPECT_EQ(at(flight, 10).phase, TrafficPhase::kFlies);
  EXPECT_LT((at(flight, 20.5).p_N - Vec3(820, 0, -300)).norm(), 1e-9);
  EXPECT_LT((flight.state().v_N - Vec3(40, 0, 0)).norm(), 1e-9);
  // Up to the jump it flies on, then it is there.
  EXPECT_LT((at(flight, 30.9).p_N - Vec3(1236, 0, -300)).norm(), 1e-9);
  EXPECT_EQ(flight.state().phase, TrafficPhase::kFlies);
  EXPECT_LT((at(flight, 31.1).p_N - Vec3(1244, 1000, -300)).norm(), 1e-9);
  EXPECT_EQ(flight.state().phase, TrafficPhase::kJumped);
  EXPECT_EQ(at(flight, 31.2).phase, TrafficPhase::kFlies);
  EXPECT_EQ(at(flight, 60).phase, TrafficPhase::kGap);
  EXPECT_EQ(at(flight, 100).phase, TrafficPhase::kFlies);
  EXPECT_EQ(at(flight, 110).phase, TrafficPhase::kFlies);
  EXPECT_EQ(at(flight, 110.1).phase, TrafficPhase::kAbsent);
}

TEST(RecordedFlight, OfOnePlaceIsThereOnceAndFastOnesDoNotJump) {
  RecordedFlight once({{5, {1, 2, -3}}}, {});
  EXPECT_EQ(at(once, 4).phase, TrafficPhase::kAbsent);
  EXPECT_EQ(at(once, 5).phase, TrafficPhase::kFlies);
  EXPECT_EQ(at(once, 6).phase, TrafficPhase::kAbsent);
  std::vector<RecordedPlace> jet;
  for (int k = 0; k < 40; ++k) jet.push_back({5.0 * k, {250.0 * 5 * k, 0, -9000}});
  EXPECT_EQ(RecordedFlight(jet, {}).faults().jumps, 0);
}

}  // namespace
}  // namespace skein::environment::traffic_flight_test
