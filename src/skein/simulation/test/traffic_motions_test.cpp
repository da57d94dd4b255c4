// SPDX-License-Identifier: Apache-2.0
#include "skein/simulation/traffic_motions.h"

#include <gtest/gtest.h>

#include <memory>

namespace skein::simulation::traffic_motions_test {
namespace {

Time s(double seconds) {
  return Time::from_seconds(seconds);
}

// Flies north, turns east at a time, and says whom it noticed.
class Turning final : public TrafficAircraft {
 public:
  void advance(const TrafficView& view) override {
    const double t = view.now.seconds();
    first_ = first_.value_or(t);
    noticed_ = view.aircraft.size();
    state_.v_N = t < 5 ? Vec3(30, 0, 0) : Vec3(0, 30, 0);
    state_.p_N = t < 5 ? Vec3(30 * t, 0, -300) : Vec3(150, 30 * (t - 5), -300);
  }
  TrafficState state() const override { return state_; }

  std::optional<double> first_;
  std::size_t noticed_ = 0;

 private:
  TrafficState state_;
};

class MotionLog : public Recorder {
 public:
  void record(const Record& record) override {
    if (const auto* m = std::get_if<TrafficMotion>(&record)) motions.push_back(*m);
  }
  std::vector<TrafficMotion> motions;
};

TEST(TrafficMotions, ShowAndRecordThoseThatAreThere) {
  std::vector<WorldTraffic> traffic;
  auto made = std::make_unique<Turning>();
  const Turning& aircraft = *made;
  traffic.emplace_back(AirTraffic{0, "glider", "straight", 0x800000, {true, false, true}},
                       std::move(made));
  traffic[0].from = s(10);
  traffic[0].until = s(20);
  TrafficMotions motions(traffic);
  const VisibleAircraft team[] = {{{1, 2, -3}, {4, 5, 6}, 3, {}, EntityId{2}}};
  MotionLog log;
  for (int i = 0; i <= 300; ++i) {
    const Time now = s(0.1 * i);
    motions.advance(now, team);
    motions.record(now, log);
    const bool there = i >= 100 && i < 200;
    ASSERT_EQ(motions.visible().size(), there ? 2u : 1u) << i;
    EXPECT_EQ(motions.visible()[0].entity, EntityId{2});
    if (!there) continue;
    EXPECT_FALSE(motions.visible()[1].entity);
    EXPECT_EQ(motions.visible()[1].address, 0x800000u);
    EXPECT_TRUE(motions.visible()[1].sends.ads_b);
    EXPECT_EQ(motions.visible()[1].p_N, aircraft.state().p_N);
  }
  EXPECT_EQ(aircraft.first_, 0) << "its own time begins when it comes";
  EXPECT_EQ(aircraft.noticed_, 1u);
  // Not there, north, east, gone.
  ASSERT_EQ(log.motions.size(), 4u);
  EXPECT_EQ(log.motions[0].phase, TrafficPhase::kAbsent);
  EXPECT_EQ(log.motions[1].time, s(10));
  EXPECT_EQ(log.motions[1].velocity, Vec3(30, 0, 0));
  EXPECT_EQ(log.motions[2].time, s(15));
  EXPECT_EQ(log.motions[2].velocity, Vec3(0, 30, 0));
  EXPECT_EQ(log.motions[3].time, s(20));
  EXPECT_EQ(log.motions[3].phase, TrafficPhase::kAbsent);
}

}  // namespace
}  // namespace skein::simulation::traffic_motions_test
