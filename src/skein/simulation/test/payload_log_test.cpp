// SPDX-License-Identifier: Apache-2.0
#include "skein/simulation/payload_log.h"

#include <gtest/gtest.h>

namespace skein::simulation::payload_log_test {
namespace {

// 100 m north at 2 s, flying east at 20 m/s, known to 3 m.
NavEstimate believed() {
  NavEstimate nav;
  nav.time = Time::from_seconds(2);
  nav.p_N = {100, 0, -50};
  nav.v_N = {0, 20, 0};
  nav.position_sd = 3;
  return nav;
}

class Log : public Recorder {
 public:
  void record(const Record& record) override {
    if (const auto* d = std::get_if<Detection>(&record)) detections.push_back(*d);
    if (const auto* f = std::get_if<Footprint>(&record)) footprints.push_back(*f);
    if (const auto* r = std::get_if<RangeScan>(&record)) scans.push_back(*r);
  }

  std::vector<Detection> detections;
  std::vector<Footprint> footprints;
  std::vector<RangeScan> scans;
};

TEST(PayloadLog, PlacesAreWhereTheAircraftBelievesItWasThen) {
  const Time then = Time::from_seconds(1.5);  // 10 m further west
  FootprintSample picture{then, {{{30, -20}, {30, 20}, {-30, 20}, {-30, -20}}}};
  const std::vector<SensorSample> samples = {picture,
                                             DetectionSample{then, 7, {5, 6}, 4}};
  Log log;
  log_payload(samples, EntityId{3}, 1, believed(), log);
  ASSERT_EQ(log.detections.size(), 1u);
  const Detection& found = log.detections[0];
  EXPECT_EQ(found.time, then);
  EXPECT_EQ(found.aircraft, EntityId{3});
  EXPECT_EQ(found.sensor, 1u);
  EXPECT_EQ(found.object, 7u);
  EXPECT_LT((found.point - Vec2(105, -4)).norm(), 1e-12);
  EXPECT_DOUBLE_EQ(found.point_sd, 5) << "own place and picture together";
  ASSERT_EQ(log.footprints.size(), 1u);
  EXPECT_EQ(log.footprints[0].time, then);
  EXPECT_LT((log.footprints[0].corners[1] - Vec2(130, 10)).norm(), 1e-12);
}

TEST(PayloadLog, BeamsOfOneTimeAreOneScan) {
  const Vec3 down{0, 0, 1};
  const Time first = Time::from_seconds(1), second = Time::from_seconds(1.1);
  const std::vector<SensorSample> samples = {
      RangeSample{first, down, 40}, RangeSample{first, down, 0},
      FireSample{first, 0, true}, RangeSample{second, down, 41}};
  Log log;
  log_payload(samples, EntityId{3}, 0, believed(), log);
  ASSERT_EQ(log.scans.size(), 2u);
  EXPECT_EQ(log.scans[0].time, first);
  ASSERT_EQ(log.scans[0].beams.size(), 2u);
  EXPECT_EQ(log.scans[0].beams[0].range, 40);
  EXPECT_EQ(log.scans[1].time, second);
  EXPECT_EQ(log.scans[1].beams.size(), 1u);
  EXPECT_TRUE(log.detections.empty());
}

}  // namespace
}  // namespace skein::simulation::payload_log_test
