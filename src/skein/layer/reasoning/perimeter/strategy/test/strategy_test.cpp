// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>
#include <utility>

#include "skein/base/random.h"
#include "skein/geo/polygon.h"
#include "skein/layer/reasoning/perimeter/strategy/boundary_line.h"
#include "skein/layer/reasoning/perimeter/strategy/ellipse.h"
#include "skein/layer/reasoning/perimeter/strategy/gus.h"
#include "skein/layer/reasoning/perimeter/strategy/orders.h"
#include "skein/layer/reasoning/perimeter/strategy/partition.h"
#include "skein/layer/reasoning/perimeter/strategy/sweep.h"
#include "skein/layer/reasoning/perimeter/strategy/time_to_go.h"
#include "skein/layer/reasoning/perimeter/strategy/tracking.h"

namespace skein::perimeter::strategy_test {
namespace {

// A circular belief of 60 points; point k at bearing 6 k degrees.
BoundaryEstimate circle(double radius, double sigma) {
  BoundaryEstimate boundary;
  boundary.rings.emplace_back();
  for (int i = 0; i < 60; ++i) {
    BoundaryPoint point;
    point.normal = geo::unit(2 * geo::kPi * i / 60);
    point.position = radius * point.normal;
    point.sigma = sigma;
    boundary.rings[0].push_back(point);
  }
  return boundary;
}

AircraftStatus aircraft_at(std::uint32_t id, const Vec2& place, double heading) {
  AircraftStatus aircraft;
  aircraft.id = EntityId{id};
  aircraft.nav.p_N = {place.x(), place.y(), -100};
  aircraft.nav.heading = heading;
  aircraft.nav.v_N = {20 * std::cos(heading), 20 * std::sin(heading), 0};
  return aircraft;
}

struct Scene {
  BoundaryEstimate boundary = circle(500, 10);
  std::vector<AircraftStatus> aircraft = {aircraft_at(0, {900, 0}, geo::kPi),
                                          aircraft_at(1, {-900, 0}, 0)};
  std::vector<Zone> zones;
  Time now = Time::from_seconds(10);
  MonitoringSituation situation() const {
    return {now, &boundary, aircraft, Vec2::Zero(), zones};
  }
};

Vec2 target(const Assignment& assignment) {
  return std::get<FlyTo>(assignment.what).point;
}

TEST(BoundaryLine, GivesTangentsWithTheFireOnTheRight) {
  const BoundaryEstimate boundary = circle(500, 10);
  const BoundaryLine line(boundary);
  EXPECT_EQ(line.size(), 60u);
  EXPECT_NEAR(line.length(), 2 * geo::kPi * 500, 3);  // a 60-gon is 0.05 % shorter
  const Vec2 along = line[1].position - line[0].position;
  EXPECT_GT(line.tangent(0).dot(along.normalized()), 0.99);
  EXPECT_EQ(line.next(59, true), 0u);
  EXPECT_EQ(line.next(0, false), 59u);
  EXPECT_EQ(line.nearest({0, 800}), 15u);
}

TEST(Gus, SendsTheFirstAircraftToTheGreatestUncertainty) {
  Scene scene;
  scene.boundary.rings[0][20].sigma = 80;
  scene.boundary.rings[0][33].sigma = 60;
  GusStrategy gus({}, false);
  const auto orders = gus.assign(scene.situation());
  ASSERT_EQ(orders.size(), 2u);
  const auto& ring = scene.boundary.rings[0];
  // Aircraft 0 comes through the fire: the aim is 0.6745 sigma outside. Aircraft 1 comes
  // from outside: the aim is inside.
  EXPECT_LT((target(orders[0]) - (500 + 0.6745 * 80) * ring[20].normal).norm(), 1e-9);
  EXPECT_LT((target(orders[1]) - (500 - 0.6745 * 60) * ring[33].normal).norm(), 1e-9);
}

TEST(Gus, CountsTheGrowthDuringTheFlight) {
  Scene scene;
  scene.boundary.rings[0][30].sigma = 12;        // near aircraft 1, larger now
  scene.boundary.rings[0][15].sigma_growth = 1;  // grows by far more until arrival
  GusStrategy gus({}, false);
  const auto orders = gus.assign(scene.situation());
  EXPECT_GT(target(orders[0]).y(), 400);
}

TEST(Gus, PerSecondPrefersWhatIsNear) {
  Scene scene;
  scene.boundary.rings[0][0].sigma = 20;   // in front of aircraft 0
  scene.boundary.rings[0][30].sigma = 25;  // on the other side of the fire
  GusStrategy plain({}, false), rate({}, true);
  EXPECT_LT(target(plain.assign(scene.situation())[0]).x(), -400);
  EXPECT_GT(target(rate.assign(scene.situation())[0]).x(), 400);
}

TEST(Gus, KeepsAnOrderUntilItIsDoneOrCrossed) {
  Scene scene;
  GusStrategy gus({}, false);
  EXPECT_EQ(gus.assign(scene.situation()).size(), 2u);
  scene.now = Time::from_seconds(20);
  EXPECT_TRUE(gus.assign(scene.situation()).empty());
  scene.aircraft[1].has_crossed = true;
  scene.aircraft[1].last_crossing = Time::from_seconds(19);
  const auto orders = gus.assign(scene.situation());
  ASSERT_EQ(orders.size(), 1u);
  EXPECT_EQ(orders[0].aircraft, EntityId{1});
}

TEST(Gus, LeavesOutNoFlightZones) {
  Scene scene;
  scene.boundary.rings[0][20].sigma = 80;
  const Vec2 centre = scene.boundary.rings[0][20].position;
  scene.zones.push_back(
      {.area = geo::Ring{centre + Vec2(-200, -200), centre + Vec2(200, -200),
                         centre + Vec2(200, 200), centre + Vec2(-200, 200)}});
  GusStrategy gus({}, false);
  for (const Assignment& order : gus.assign(scene.situation()))
    EXPECT_FALSE(in_zone(scene.zones, target(order)));
}

TEST(Ellipse, FliesToTheTipAndSwitchesWhenAnotherAxisIsLonger) {
  Scene scene;
  scene.aircraft.pop_back();
  scene.boundary.rings[0][10].major_axis = {0, 90};
  EllipseStrategy ellipse({});
  auto orders = ellipse.assign(scene.situation());
  ASSERT_EQ(orders.size(), 1u);
  EXPECT_NEAR((target(orders[0]) - scene.boundary.rings[0][10].position).norm(), 90,
              1e-9);
  scene.now += Time::from_seconds(1);
  EXPECT_TRUE(ellipse.assign(scene.situation()).empty());
  scene.boundary.rings[0][40].major_axis = {120, 0};
  orders = ellipse.assign(scene.situation());
  ASSERT_EQ(orders.size(), 1u);
  EXPECT_NEAR((target(orders[0]) - scene.boundary.rings[0][40].position).norm(), 120,
              1e-9);
}

TEST(Tracking, StartsEvenlySpacedNearTheAircraft) {
  Scene scene;
  TrackingStrategy tracking({});
  const auto orders = tracking.assign(scene.situation());
  ASSERT_EQ(orders.size(), 2u);
  const Vec2 a = std::get<FollowEdge>(orders[0].what).start;
  const Vec2 b = std::get<FollowEdge>(orders[1].what).start;
  EXPECT_GT(a.x(), 490);
  EXPECT_LT(b.x(), -490);
  EXPECT_TRUE(tracking.assign(scene.situation()).empty());
}

TEST(Tracking, PredictedOrdersTheBelievedLine) {
  Scene scene;
  TrackingOptions options;
  options.predicted = true;
  options.look_ahead = 600;
  TrackingStrategy tracking(options);
  const auto orders = tracking.assign(scene.situation());
  ASSERT_EQ(orders.size(), 2u);
  const auto& points = std::get<FollowLine>(orders[0].what).points;
  EXPECT_EQ(points.size(), 12u);  // 600 m in steps of 52.3 m
  for (const Vec2& point : points) EXPECT_NEAR(point.norm(), 500, 1e-9);
  scene.now += Time::from_seconds(11);
  EXPECT_EQ(tracking.assign(scene.situation()).size(), 2u);
}

TEST(Partition, KeepsEachAircraftInItsOwnHalf) {
  Scene scene;
  scene.boundary.rings[0][28].sigma = 200;  // south: the half of aircraft 1
  PartitionStrategy partition({});
  const auto orders = partition.assign(scene.situation());
  ASSERT_EQ(orders.size(), 2u);
  EXPECT_GT(target(orders[0]).x(), -60);
  EXPECT_LT(target(orders[1]).x(), -300);
}

TEST(Sweep, PutsAircraftOnDifferentArcsAndStays) {
  Scene scene;
  SweepStrategy sweep({});
  const auto orders = sweep.assign(scene.situation());
  ASSERT_EQ(orders.size(), 2u);
  const Vec2 a = std::get<FollowEdge>(orders[0].what).start;
  const Vec2 b = std::get<FollowEdge>(orders[1].what).start;
  EXPECT_GT((a - b).norm(), 400);
  scene.now += Time::from_seconds(11);
  EXPECT_TRUE(sweep.assign(scene.situation()).empty());
}

TEST(Sweep, SpreadsMoreAircraftThanThereAreArcs) {
  Scene scene;
  scene.boundary = circle(2000, 50);  // 12.6 km: seven windows of 1.8 km
  scene.aircraft.clear();
  for (unsigned k = 0; k < 60; ++k)
    scene.aircraft.push_back(aircraft_at(k, {2400, 10.0 * k}, 0));
  SweepStrategy sweep({});
  std::array<int, 6> in_sector{};
  const auto orders = sweep.assign(scene.situation());
  ASSERT_EQ(orders.size(), 60u);
  for (const Assignment& order : orders) {
    const double bearing = geo::bearing(std::get<FollowEdge>(order.what).start);
    ++in_sector[static_cast<std::size_t>(geo::wrap_2pi(bearing) / (2 * geo::kPi) * 6) %
                6];
  }
  // Ten each would be even; the near side is a little better.
  for (const int count : in_sector) EXPECT_TRUE(count >= 5 && count <= 18) << count;
}

TEST(Sweep, OrdersNothingWhereNoPlaceIsAllowed) {
  Scene scene;
  scene.zones = {
      {.area = geo::Ring{{-5000, -5000}, {5000, -5000}, {5000, 5000}, {-5000, 5000}}}};
  EXPECT_TRUE(SweepStrategy({}).assign(scene.situation()).empty());
}

TEST(Sweep, PutsNoTwoOfManyAtOnePlace) {
  Scene scene;
  scene.boundary = circle(2000, 50);
  scene.aircraft.clear();
  const unsigned count = static_cast<unsigned>(scene.boundary.rings[0].size());
  for (unsigned k = 0; k < count; ++k)
    scene.aircraft.push_back(aircraft_at(k, {2400, 0}, 0));
  SweepStrategy sweep({});
  std::set<std::pair<double, double>> places;
  for (const Assignment& order : sweep.assign(scene.situation())) {
    const auto& edge = std::get<FollowEdge>(order.what);
    places.insert({edge.start.x(), edge.start.y()});
  }
  EXPECT_EQ(places.size(), count);
}

// Aircraft and points of a moving boundary, drawn at random.
BoundaryPoint random_point(RandomStream& random) {
  BoundaryPoint point;
  point.normal = geo::unit(random.uniform(0, 2 * geo::kPi));
  point.position = random.uniform(0, 3000) * geo::unit(random.uniform(0, 2 * geo::kPi));
  point.rate = random.uniform(-1, 4);
  return point;
}

TEST(TimeToGo, NoPointIsMetBeforeTheLeastTime) {
  RandomStream random(1, 0, Purpose::kTest);
  for (int k = 0; k < 5000; ++k) {
    AircraftStatus aircraft = aircraft_at(0, {0, 0}, random.uniform(0, 2 * geo::kPi));
    aircraft.nav.wind_N = random.uniform(0, 15) * geo::unit(random.uniform(0, 6));
    const BoundaryPoint point = random_point(random);
    EXPECT_LE(min_time_to_meet(aircraft, point), meet(aircraft, point).t_go) << k;
  }
}

// The first order of an aircraft alone is worth as much as the best of all arcs.
TEST(Sweep, PassesOverNoBetterArc) {
  RandomStream random(2, 0, Purpose::kTest);
  const SweepOptions options;
  for (int k = 0; k < 100; ++k) {
    Scene scene;
    scene.boundary = circle(random.uniform(100, 3000), 0);
    for (BoundaryPoint& point : scene.boundary.rings[0]) {
      point.sigma = random.uniform(1, 50);
      point.sigma_growth = random.uniform(-0.05, 0.2);
      point.rate = random.uniform(0, 1);
    }
    scene.aircraft = {aircraft_at(0, {random.uniform(-4000, 4000), 0}, 1)};
    const BoundaryLine line(scene.boundary);
    const double window = std::min(options.window * options.follow_speed, line.length());
    double best = 0;
    for (std::size_t start = 0; start < line.size(); ++start)
      for (const bool clockwise : {true, false}) {
        const double t_go = meet(scene.aircraft[0], line[start]).t_go;
        double sum = 0, gone = 0;
        std::size_t i = start;
        do {
          const double later = t_go + gone / options.follow_speed;
          sum += carried_on(line[i], later).sigma * line.spacing(i);
          gone += line.spacing(clockwise ? i : line.next(i, false));
          i = line.next(i, clockwise);
        } while (gone < window && i != start);
        best = std::max(best, sum / (t_go + window / options.follow_speed));
      }
    const auto orders = SweepStrategy(options).assign(scene.situation());
    ASSERT_EQ(orders.size(), 1u);
    EXPECT_NEAR(orders[0].why[0].value, best, 1e-9 * best) << k;
  }
}

TEST(Sweep, LeavesAKnownArcForAnUncertainOne) {
  Scene scene;
  scene.boundary = circle(2000, 10);
  scene.aircraft = {aircraft_at(0, {2000, 0}, geo::kPi / 2)};
  SweepStrategy sweep({});
  ASSERT_EQ(sweep.assign(scene.situation()).size(), 1u);
  for (int i = 25; i < 35; ++i)
    scene.boundary.rings[0][static_cast<std::size_t>(i)].sigma = 300;
  scene.now += Time::from_seconds(100);
  const auto orders = sweep.assign(scene.situation());
  ASSERT_EQ(orders.size(), 1u);
  EXPECT_LT(std::get<FollowEdge>(orders[0].what).start.x(), -1000);
}

TEST(AllStrategies, TakeAnEmptyBoundaryAndNoAircraft) {
  Scene nobody;
  nobody.aircraft.clear();
  Scene nothing;
  nothing.boundary.rings.clear();
  GusStrategy gus({}, true);
  EllipseStrategy ellipse({});
  TrackingStrategy tracking({});
  PartitionStrategy partition({});
  SweepStrategy sweep({});
  for (MonitoringStrategy* strategy : std::initializer_list<MonitoringStrategy*>{
           &gus, &ellipse, &tracking, &partition, &sweep}) {
    EXPECT_TRUE(strategy->assign(nobody.situation()).empty());
    EXPECT_TRUE(strategy->assign(nothing.situation()).empty());
  }
}

}  // namespace
}  // namespace skein::perimeter::strategy_test
