// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/avoidance/alerting/traffic_alerting.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace skein::reasoning::traffic_alerting_test {
namespace {

constexpr EntityId kSelf{3};

// An own aircraft that flies north at 20 m/s and 300 m, and an intruder.
class Sky {
 public:
  explicit Sky(Vec3 p_N, Vec3 v_N) : p_N_(std::move(p_N)), v_N_(std::move(v_N)) {}

  AgentOutput fly(double from, double until, bool tracked = true, bool flies = true) {
    AgentOutput out;
    for (double t = from; t < until - 1e-9; t += 0.5) step(t, tracked, flies, out);
    return out;
  }
  int goals() const { return goals_; }

 private:
  void step(double t, bool tracked, bool flies, AgentOutput& out) {
    NavEstimate nav;
    nav.time = Time::from_seconds(t);
    nav.p_N = Vec3(20 * t, 0, -300);
    nav.v_N = Vec3(20, 0, 0);
    AgentInput in;
    in.now = nav.time;
    in.nav = &nav;
    if (tracked) {
      TrafficMeasurement m;
      m.time = in.now;
      m.source = TrafficSource::kBroadcast;
      m.address = 77;
      m.p_N = p_N_ + t * v_N_;
      m.p_covariance = Vec3(25, 25, 25).asDiagonal();
      m.v_N = v_N_;
      m.v_sd = 0.5;
      tracker_.step(in.now, std::span(&m, 1), {});
    } else {
      tracker_.step(in.now, {}, {});
    }
    const auto goal = [&] {
      ++goals_;
      return model::FlightGoal{0, 20, 0, 300};
    };
    alerting_.step(kSelf, in, tracker_.tracks(), flies, goal, out);
  }

  Vec3 p_N_, v_N_;
  TrafficTracker tracker_;
  TrafficAlerting alerting_{nullptr};
  int goals_ = 0;
};

template <class T>
std::vector<T> records_of(const AgentOutput& out) {
  std::vector<T> all;
  for (const AgentRecord& each : out.records)
    if (const auto* record = std::get_if<T>(&each)) all.push_back(*record);
  return all;
}

Sky head_on() {
  return Sky(Vec3(6000, 0, -300), Vec3(-50, 0, 0));
}

TEST(TrafficAlerting, RisesWithAHeadOnAndSaysEachLevelOnce) {
  Sky sky = head_on();
  const AgentOutput out = sky.fly(0, 80);
  const auto alerts = records_of<TrafficAlert>(out);
  ASSERT_GE(alerts.size(), 2u);
  std::vector<std::uint32_t> rising;
  for (const TrafficAlert& each : alerts) {
    EXPECT_LE(each.level, 3u);
    if (rising.empty() || each.level > rising.back()) rising.push_back(each.level);
  }
  EXPECT_EQ(rising.back(), 3u);
  const auto said =
      std::ranges::count(out.events, EventKind::kTrafficAlert, &Event::kind);
  EXPECT_EQ(said, static_cast<std::ptrdiff_t>(rising.size()));
  EXPECT_NE(out.events.front().text.find("traffic, 12 o'clock"), std::string::npos)
      << out.events.front().text;
}

TEST(TrafficAlerting, AdvisesATurnAndRecordsBandsOnceASecond) {
  Sky sky = head_on();
  const auto bands = records_of<FlightBands>(sky.fly(0, 62));
  ASSERT_GE(bands.size(), 20u);
  EXPECT_LE(bands.size(), 63u);
  const auto corrective =
      std::ranges::find_if(bands, [](const FlightBands& b) { return b.level >= 2; });
  ASSERT_NE(corrective, bands.end());
  ASSERT_TRUE(corrective->track_advised);
  EXPECT_FALSE(corrective->tracks.empty());
  for (const TrackBand& band : corrective->tracks) {
    const bool inside = *corrective->track_advised > band.from + 1e-9 &&
                        *corrective->track_advised < band.to - 1e-9;
    EXPECT_FALSE(inside && band.region >= AlertRegion::kMid &&
                 band.region != AlertRegion::kRecovery);
  }
}

TEST(TrafficAlerting, IsOverWhenTheOtherHasPassed) {
  Sky sky = head_on();
  const AgentOutput out = sky.fly(0, 140);
  const auto alerts = records_of<TrafficAlert>(out);
  ASSERT_FALSE(alerts.empty());
  EXPECT_EQ(alerts.back().level, 0u);
  EXPECT_EQ(records_of<FlightBands>(out).back().level, 0u);
  EXPECT_EQ(std::ranges::count(out.events, EventKind::kClearOfTraffic, &Event::kind), 1);
}

TEST(TrafficAlerting, IsOverWhenTheTrackIsLostOrTheAircraftLands) {
  for (const bool lands : {false, true}) {
    Sky sky = head_on();
    ASSERT_FALSE(records_of<TrafficAlert>(sky.fly(0, 60)).empty());
    const AgentOutput out = sky.fly(60, 75, lands, !lands);
    const auto alerts = records_of<TrafficAlert>(out);
    ASSERT_FALSE(alerts.empty());
    EXPECT_EQ(alerts.back().level, 0u);
    EXPECT_EQ(out.events.back().kind, EventKind::kClearOfTraffic);
  }
}

TEST(TrafficAlerting, SaysNothingAndWorksOutNoBandsOfWhoPassesFarAway) {
  Sky sky(Vec3(3000, 9000, -1500), Vec3(0, -20, 0));
  const AgentOutput out = sky.fly(0, 100);
  EXPECT_TRUE(out.records.empty());
  EXPECT_TRUE(out.events.empty());
  EXPECT_EQ(sky.goals(), 0);
}

}  // namespace
}  // namespace skein::reasoning::traffic_alerting_test
