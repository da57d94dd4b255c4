// SPDX-License-Identifier: Apache-2.0
#include "skein/record/figures/traffic_statistics.h"

#include <gtest/gtest.h>

namespace skein::record::traffic_statistics_test {
namespace {

TrafficBeliefRecord belief(double time, const Vec3& p_N, std::uint32_t track = 1) {
  TrafficBeliefRecord record;
  record.time = Time::from_seconds(time);
  record.id = EntityId{2};
  record.value.track = track;
  record.value.position = p_N;
  record.value.horizontal_sd = 10;
  record.value.firm = true;
  return record;
}

TEST(TrafficStatistics, CompareFirmTracksWithTheTruth) {
  TrafficStatistics statistics;
  statistics.aircraft({0, "one", "straight", 7, {}});
  statistics.aircraft({1, "other", "straight", 8, {}});
  statistics.motion({Time(), 0, {0, 0, -300}, {10, 0, 0}});
  statistics.motion({Time(), 1, {0, 90, -300}, {10, 0, 0}});
  statistics.belief(belief(1, {13, 4, -296}));   // 5 m from the first, 4 m below
  statistics.belief(belief(2, {20, 75, -300}));  // 15 m from the other
  TrafficBeliefRecord of_other = belief(3, {30, 33, -300});
  of_other.value.address = 8;  // 57 m from whom it says it is
  statistics.belief(of_other);
  statistics.belief(belief(4, {900, 900, -300}, 5));  // nobody is there
  TrafficBeliefRecord loose = belief(5, {500, 0, -300}, 6);
  loose.value.firm = false;
  statistics.belief(loose);
  std::map<std::string, double> figures;
  statistics.add_figures(figures);
  EXPECT_EQ(figures["traffic"], 2);
  EXPECT_EQ(figures["traffic_tracks"], 2);
  EXPECT_EQ(figures["traffic_tracks_astray_s"], 1);
  EXPECT_NEAR(figures["traffic_error_rms_m"], std::sqrt((25.0 + 225 + 57 * 57) / 3),
              1e-9);
  EXPECT_NEAR(figures["traffic_error_max_m"], 57, 1e-9);
  EXPECT_NEAR(figures["traffic_vertical_error_rms_m"], std::sqrt(16.0 / 3), 1e-9);
  EXPECT_NEAR(figures["traffic_within_2_sigma"], 2.0 / 3, 1e-9);
}

TEST(TrafficStatistics, CountEncountersByTheTruth) {
  TrafficStatistics statistics;
  statistics.aircraft({0, "one", "straight", 7, {}});
  statistics.motion({Time(), 0, {0, 0, -300}, {0, 0, 0}});
  const auto at = [&](double time, const Vec3& p_N, bool on_ground = false) {
    VehicleState state;
    state.p_N = p_N;
    state.on_ground = on_ground;
    statistics.truth(Time::from_seconds(time), EntityId{2}, state);
  };
  at(1, {100, 0, -310}, true);  // it stands
  at(2, {600, 0, -340});        // well clear is lost
  at(3, {100, 0, -310});        // and it is near
  at(40, {150, 0, -310});       // still the same
  at(90, {150, 0, -310});       // still
  at(151, {150, 0, -310});      // once more
  at(152, {100, 0, -331});      // 31 m above
  std::map<std::string, double> figures;
  statistics.add_figures(figures);
  EXPECT_EQ(figures["traffic_near_collisions"], 2);
  EXPECT_EQ(figures["traffic_well_clear_lost"], 2);
}

TEST(TrafficStatistics, KnowWhoIsNotThereAndSayNothingOfNothing) {
  TrafficStatistics statistics;
  std::map<std::string, double> figures;
  statistics.add_figures(figures);
  EXPECT_TRUE(figures.empty());
  statistics.aircraft({0, "one", "recorded", 7, {}});
  statistics.motion({Time(), 0, {0, 0, -300}, {0, 0, 0}, TrafficPhase::kAbsent});
  statistics.motion({Time::from_seconds(5), 0, {0, 0, -300}, {0, 0, 0}});
  statistics.belief(belief(1, {0, 0, -300}));
  statistics.belief(belief(6, {0, 0, -300}));
  statistics.add_figures(figures);
  EXPECT_EQ(figures["traffic_tracks_astray_s"], 1);
  EXPECT_EQ(figures["traffic_error_rms_m"], 0);
}

}  // namespace
}  // namespace skein::record::traffic_statistics_test
