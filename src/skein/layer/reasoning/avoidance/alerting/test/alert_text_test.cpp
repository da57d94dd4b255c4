// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/avoidance/alerting/alert_text.h"

#include <gtest/gtest.h>

#include "skein/geo/vec.h"

namespace skein::reasoning::alert_text_test {
namespace {

TrafficAlert traffic(double bearing_deg, double distance, double height) {
  TrafficAlert alert;
  alert.level = 2;
  alert.bearing = geo::radians(bearing_deg);
  alert.distance = distance;
  alert.height = height;
  return alert;
}

TEST(AlertText, SaysWhereAndWhatToFly) {
  TrafficAlert alert = traffic(62, 1234, 42);
  alert.track_advised = geo::radians(80.2);
  EXPECT_EQ(spoken(alert, geo::radians(20), 0),
            "traffic, 2 o'clock, 1.2 km, 40 m above, turn right 080");
  EXPECT_EQ(spoken(alert, geo::radians(120), 0),
            "traffic, 2 o'clock, 1.2 km, 40 m above, turn left 080");
  alert.track_advised = geo::radians(-0.4);
  EXPECT_EQ(spoken(alert, geo::radians(-30), 0),
            "traffic, 2 o'clock, 1.2 km, 40 m above, turn right 000");
}

TEST(AlertText, HasTwelveHours) {
  const std::pair<double, int> kHours[] = {{0, 12},  {-14, 12}, {16, 1},  {90, 3},
                                           {179, 6}, {-179, 6}, {-90, 9}, {-30, 11}};
  for (const auto& [bearing, hour] : kHours)
    EXPECT_EQ(spoken(traffic(bearing, 640, -14), 0, 0),
              "traffic, " + std::to_string(hour) + " o'clock, 640 m, same altitude")
        << bearing;
}

TEST(AlertText, ClimbsWhereNoTrackHelpsThenChangesSpeed) {
  TrafficAlert alert = traffic(0, 500, -120);
  alert.vertical_speed_advised = 3;
  alert.speed_advised = 17.6;
  EXPECT_EQ(spoken(alert, 0, 0),
            "traffic, 12 o'clock, 500 m, 120 m below, climb 3.0 m/s");
  EXPECT_EQ(spoken(alert, 0, 3), "traffic, 12 o'clock, 500 m, 120 m below, fly 18 m/s")
      << "it climbs so already";
  alert.vertical_speed_advised = 0;
  EXPECT_EQ(spoken(alert, 0, 2), "traffic, 12 o'clock, 500 m, 120 m below, level off");
}

}  // namespace
}  // namespace skein::reasoning::alert_text_test
