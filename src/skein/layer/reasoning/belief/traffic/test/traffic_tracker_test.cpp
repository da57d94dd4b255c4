// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/belief/traffic/traffic_tracker.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

namespace skein::reasoning::traffic_tracker_test {
namespace {

Time s(double seconds) {
  return Time::from_seconds(seconds);
}

// An aircraft that flies evenly, and how it is measured.
struct Intruder {
  Vec3 p_N, v_N;
  std::optional<std::uint32_t> address = {};

  Vec3 at(double t) const { return p_N + t * v_N; }
};

struct Measurer {
  std::mt19937_64 random{11};
  std::normal_distribution<double> normal{};

  TrafficMeasurement broadcast(const Intruder& of, double t) {
    TrafficMeasurement m;
    m.time = s(t);
    m.address = of.address;
    m.p_N = of.at(t) + 10 * draw3();
    m.p_covariance = 100 * Mat3::Identity();
    m.v_N = of.v_N + 0.7 * draw3();
    m.v_sd = 0.7;
    return m;
  }
  TrafficMeasurement radar(const Intruder& of, double t) {
    const Vec3 p = of.at(t);
    const double range = p.norm();
    return from_polar(s(t), TrafficSource::kRadar, Vec3::Zero(),
                      {range + 15 * normal(random), 15,
                       geo::bearing(p.head<2>()) + 0.01 * normal(random), 0.01,
                       math::asin(-p.z() / range) + 0.01 * normal(random), 0.01});
  }
  Vec3 draw3() { return {normal(random), normal(random), normal(random)}; }
};

double off(const TrafficTrack& track, const Intruder& from, double t) {
  return (track.filter.at(s(t)).p_N - from.at(t)).norm();
}

TEST(TrafficTracker, KeepsTwoApartThatCross) {
  const Intruder one{{2000, -1000, -300}, {0, 40, 0}},
      other{{3000, 0, -300}, {-40, 0, 0}};
  Measurer measure;
  TrafficTracker tracker;
  for (int t = 0; t < 60; ++t) {
    const std::array looks{measure.radar(one, t), measure.radar(other, t)};
    tracker.step(s(t), looks, {});
    // One look in 300 is off so far that it begins a track, which is never firm.
    ASSERT_EQ(std::ranges::count_if(tracker.tracks(), is_firm), t >= 2 ? 2 : 0) << t;
  }
  EXPECT_EQ(tracker.tracks()[0].number, 1u);
  EXPECT_EQ(tracker.tracks()[1].number, 2u);
  EXPECT_LT(off(tracker.tracks()[0], one, 59), 60);
  EXPECT_LT(off(tracker.tracks()[1], other, 59), 60);
}

TEST(TrafficTracker, TakesTwoSourcesOfOneForOne) {
  const Intruder one{{2500, 200, -300}, {-30, 5, 1}, 0xABCDEF};
  Measurer measure;
  TrafficTracker tracker;
  for (int t = 0; t < 40; ++t) {
    // Each has its own time within the second, and the radar's comes late.
    std::vector<TrafficMeasurement> looks;
    if (t % 3 != 0) looks.push_back(measure.broadcast(one, t));
    looks.push_back(measure.radar(one, t - 0.6));
    tracker.step(s(t), looks, {});
  }
  ASSERT_EQ(tracker.tracks().size(), 1u);
  EXPECT_EQ(tracker.tracks()[0].address, 0xABCDEFu);
  EXPECT_LT(off(tracker.tracks()[0], one, 39), 25);
}

TEST(TrafficTracker, CoastsForTenSecondsAndThenForgets) {
  const Intruder one{{2500, 200, -300}, {-30, 5, 1}, 7};
  Measurer measure;
  TrafficTracker tracker;
  for (int t = 0; t <= 5; ++t)
    tracker.step(s(t), std::array{measure.broadcast(one, t)}, {});
  tracker.step(s(14.9), {}, {});
  ASSERT_EQ(tracker.tracks().size(), 1u);
  EXPECT_LT(off(tracker.tracks()[0], one, 14.9), 60);
  tracker.step(s(15), {}, {});
  EXPECT_TRUE(tracker.tracks().empty());
  // Back, it is another one.
  tracker.step(s(30), std::array{measure.broadcast(one, 30)}, {});
  ASSERT_EQ(tracker.tracks().size(), 1u);
  EXPECT_EQ(tracker.tracks()[0].number, 2u);
  EXPECT_FALSE(is_firm(tracker.tracks()[0]));
}

TEST(TrafficTracker, CountsNobodyOfTheTeam) {
  const Intruder member{{1200, 300, -200}, {20, 0, 0}},
      intruder{{2200, 300, -200}, {20, 0, 0}};
  Measurer measure;
  TrafficTracker tracker;
  for (int t = 0; t < 20; ++t) {
    const std::array team{TeamPlace{member.at(t), 5}};
    tracker.step(s(t), std::array{measure.radar(member, t), measure.radar(intruder, t)},
                 team);
  }
  ASSERT_EQ(tracker.tracks().size(), 1u);
  EXPECT_LT(off(tracker.tracks()[0], intruder, 19), 60);
}

TEST(TrafficTracker, TakesAnAddressThatJumpsForAnotherAircraft) {
  const Intruder one{{2500, 200, -300}, {-30, 0, 0}, 7};
  Measurer measure;
  TrafficTracker tracker;
  for (int t = 0; t < 5; ++t)
    tracker.step(s(t), std::array{measure.broadcast(one, t)}, {});
  TrafficMeasurement jumped = measure.broadcast(one, 5);
  jumped.p_N.x() += 1000;
  tracker.step(s(5), std::array{jumped}, {});
  ASSERT_EQ(tracker.tracks().size(), 2u);
  EXPECT_TRUE(is_firm(tracker.tracks()[0]));
  EXPECT_FALSE(is_firm(tracker.tracks()[1]));
  // And goes on with the first when it is where that was to be expected.
  tracker.step(s(6), std::array{measure.broadcast(one, 6)}, {});
  EXPECT_EQ(tracker.tracks().size(), 2u);
  EXPECT_EQ(tracker.tracks()[0].updates, 6);
}

TEST(TrafficTracker, LeavesOutWhatCannotBeAndStaysSmall) {
  Measurer measure;
  TrafficTracker tracker;
  const Intruder one{{2500, 200, -300}, {-30, 0, 0}, 7};
  TrafficMeasurement broken = measure.broadcast(one, 20);
  broken.p_N.x() = std::numeric_limits<double>::infinity();
  const TrafficMeasurement old = measure.broadcast(one, 5);
  const TrafficMeasurement future = measure.broadcast(one, 30);
  tracker.step(s(20), std::array{broken, old, future}, {});
  EXPECT_TRUE(tracker.tracks().empty());
  // The same again counts once.
  const TrafficMeasurement twice = measure.broadcast(one, 20);
  tracker.step(s(20), std::array{twice, twice}, {});
  ASSERT_EQ(tracker.tracks().size(), 1u);
  EXPECT_EQ(tracker.tracks()[0].updates, 1);
  for (std::uint32_t k = 0; k < 3000; ++k) {
    const Intruder many{{500.0 * k, 0, -300}, {0, 0, 0}, 100 + k};
    tracker.step(s(21), std::array{measure.broadcast(many, 21)}, {});
  }
  EXPECT_EQ(tracker.tracks().size(), TrafficTracker::kMaxTracks);
}

}  // namespace
}  // namespace skein::reasoning::traffic_tracker_test
