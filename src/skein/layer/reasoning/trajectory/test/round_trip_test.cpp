// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/trajectory/round_trip.h"

#include <gtest/gtest.h>

#include "skein/layer/reasoning/trajectory/zone_monitor.h"

namespace skein::reasoning::round_trip_test {
namespace {

TEST(RoundTrip, PointsOnOneAnotherAreOne) {
  const FlyWaypoints route =
      round_trip({{0, 0}, {0, 0}, {100, 0}, {100, 0.1}, {100, 80}, {0, 0}}, 7, 120);
  ASSERT_EQ(route.points.size(), 3u);
  EXPECT_EQ(route.points[1].point, Vec2(100, 0));
  EXPECT_EQ(route.points[2].altitude_msl, 120);
  EXPECT_EQ(route.laps, 7);
  const FlyWaypoints place = round_trip({{5, 5}, {5, 5}}, 1000, 120);
  ASSERT_EQ(place.points.size(), 1u);
  EXPECT_EQ(place.laps, 1);
}

// 200 m by 200 m, 100 m north of the origin.
std::vector<Zone> zone() {
  return {{geo::Ring{{100, -100}, {100, 100}, {300, 100}, {300, -100}}}};
}

TEST(IntoZone, SaysWhereALineFirstEnters) {
  const auto at = into_zone(std::vector<Vec2>{{0, 0}, {500, 0}}, false, zone());
  ASSERT_TRUE(at);
  EXPECT_EQ(*at, Vec2(100, 0));
  EXPECT_EQ(into_zone(std::vector<Vec2>{{500, 0}, {0, 0}}, false, zone()), Vec2(300, 0));
  EXPECT_EQ(into_zone(std::vector<Vec2>{{200, 0}}, false, zone()), Vec2(200, 0));
  EXPECT_EQ(into_zone(std::vector<Vec2>{{150, 0}, {160, 0}}, false, zone()),
            Vec2(150, 0));
}

TEST(IntoZone, CountsTheLegBackOnlyWhenItIsFlown) {
  const std::vector<Vec2> route = {{0, 0}, {0, 200}, {500, 200}, {500, 0}};
  EXPECT_FALSE(into_zone(route, false, zone()));
  EXPECT_EQ(into_zone(route, true, zone()), Vec2(300, 0));
  EXPECT_FALSE(into_zone(route, true, {}));
}

TEST(ZoneMonitor, ReportsOnceWhenTheAircraftComesInAndWhenItLeaves) {
  ZoneMonitor watch({}, {}, zone(), EntityId{3});
  std::vector<std::string> reported;
  NavEstimate nav;
  for (const double north : {0.0, 150.0, 200.0, 290.0, 350.0, 400.0}) {
    nav.p_N.x() = north;
    AgentInput in;
    in.nav = &nav;
    AgentOutput out;
    watch.look(in, out);
    for (const Event& event : out.events) {
      EXPECT_EQ(event.kind, EventKind::kZone);
      reported.push_back(event.text);
    }
  }
  EXPECT_EQ(reported,
            (std::vector<std::string>{"is inside a no-fly zone", "has left the zone"}));
}

}  // namespace
}  // namespace skein::reasoning::round_trip_test
