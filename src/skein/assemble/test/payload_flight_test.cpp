// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "skein/assemble/test/whole_flight.h"

namespace skein::assemble::payload_flight_test {
namespace {

// North along a line over a car and past a man; a second car is far away.
const std::string kSearch =
    "duration_s: 60\nseed: 4\nenvironment:\n  objects:\n"
    "    - {name: car, position_m: [500, 20]}\n"
    "    - {name: man, position_m: [900, -30], movement: {kind: even, velocity_mps: [-1, "
    "0]}}\n"
    "    - {name: lost, position_m: [500, 5000]}\n"
    "aircraft:\n  - name: scout\n"
    "    agent: {kind: route, points_m: [[3000, 0]]}\n"
    "    start: {placement: list, positions_m: [[0, 0]], heading_deg: 0}\n"
    "    sensors: [gnss, air-data, {kind: camera, rate_hz: 2}, {kind: lidar, "
    "depression_deg: 90}]\n";

TEST(PayloadFlight, WhatItsCameraAndLidarSeeIsRecorded) {
  const FlightLog log = fly(kSearch);
  int cars = 0, men = 0;
  for (const Detection& found : log.detections) {
    ASSERT_LT(found.object, 2u) << "the third is out of sight";
    (found.object == 0 ? cars : men) += 1;
    EXPECT_EQ(found.sensor, 0u);
    const Vec2 where =
        found.object == 0 ? Vec2(500, 20) : Vec2(900 - found.time.seconds(), -30);
    // Five standard deviations, both axes: one in a million fails.
    EXPECT_LT((found.point - where).norm(), 5.5 * found.point_sd) << found.object;
    EXPECT_GT(found.point_sd, 1);
  }
  EXPECT_GT(cars, 3);
  EXPECT_GT(men, 3);
  // 5 scans a second, straight down over flat ground, 120 m below.
  EXPECT_NEAR(static_cast<double>(log.scans.size()), 300, 3);
  for (const RangeScan& scan : log.scans) {
    ASSERT_EQ(scan.beams.size(), 31u);
    EXPECT_EQ(scan.sensor, 1u);
    EXPECT_NEAR(scan.beams[15].range, 120, 12) << "banked by 25 degrees at most";
  }
}

TEST(PayloadFlight, IsTheSameForAnyNumberOfThreads) {
  std::string scenario = kSearch;
  scenario.replace(scenario.find("name: scout"), 11, "name: scout\n    count: 40");
  scenario.replace(scenario.find("placement: list, positions_m: [[0, 0]]"), 38,
                   "placement: line, spacing_m: 5");
  const FlightLog one = fly(scenario), three = fly(scenario, {{}, 3});
  EXPECT_GT(one.detections.size(), 40u);
  EXPECT_EQ(one.hash(), three.hash());
}

}  // namespace
}  // namespace skein::assemble::payload_flight_test
