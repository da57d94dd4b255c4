// SPDX-License-Identifier: Apache-2.0
#include "skein/record/figures/alert_statistics.h"

#include <gtest/gtest.h>

namespace skein::record::alert_statistics_test {
namespace {

AlertRecord alert(double time, std::uint32_t track, std::uint32_t level,
                  std::uint32_t who = 1) {
  AlertRecord record{Time::from_seconds(time), EntityId{who}, {}};
  record.value.track = track;
  record.value.level = level;
  return record;
}

RecommendationRecord recommendation(double time, std::uint32_t number,
                                    RecommendationState state) {
  return {Time::from_seconds(time), EntityId{1}, {number, state, "aside", {}}};
}

ConflictRecord conflict(double seen, double meets) {
  ConflictRecord record{Time::from_seconds(meets + 30), EntityId{1}, {}};
  record.value.seen = Time::from_seconds(seen);
  record.value.meets = Time::from_seconds(meets);
  return record;
}

TEST(AlertStatistics, CountsAlertsThatBeginAndHowLongTheyLast) {
  AlertStatistics statistics;
  for (const AlertRecord& each :
       {alert(10, 4, 1), alert(12, 4, 2), alert(14, 4, 1), alert(11, 4, 3, 2),
        alert(20, 4, 0), alert(25, 4, 0, 2), alert(30, 4, 2)})
    statistics.alert(each);
  std::map<std::string, double> figures;
  statistics.add_figures(figures);
  EXPECT_EQ(figures.at("traffic_alerts"), 3) << "two aircraft, one of them twice";
  EXPECT_EQ(figures.at("traffic_alert_level_max"), 3);
  EXPECT_EQ(figures.at("traffic_alert_s"), 10 + 14) << "the third goes on";
}

TEST(AlertStatistics, SaysNothingOfARunWithoutIntruders) {
  AlertStatistics statistics;
  TrafficBelief loose;
  statistics.belief(loose);
  std::map<std::string, double> figures;
  statistics.add_figures(figures);
  EXPECT_TRUE(figures.empty());
  loose.firm = true;
  statistics.belief(loose);
  statistics.add_figures(figures);
  EXPECT_EQ(figures.at("traffic_alerts"), 0);
}

TEST(AlertStatistics, TakesTheLastPathThatWasFollowedBeforeTheConflict) {
  AlertStatistics statistics;
  using enum RecommendationState;
  for (const std::uint32_t number : {1u, 2u, 3u, 4u, 5u})
    statistics.recommendation(recommendation(10 * number, number, kShown));
  statistics.recommendation(recommendation(5, 1, kFollowed));
  statistics.recommendation(recommendation(50, 2, kFollowed));
  statistics.recommendation(recommendation(90, 3, kFollowed));
  statistics.recommendation(recommendation(95, 3, kShown));
  statistics.recommendation(recommendation(95, 3, kFollowed));  // its path has changed
  statistics.recommendation(recommendation(200, 4, kFollowed));
  statistics.recommendation(recommendation(60, 5, kIgnored));
  statistics.conflict(conflict(40, 150));
  statistics.conflict(conflict(0, 300));
  std::map<std::string, double> figures;
  statistics.add_figures(figures);
  EXPECT_EQ(figures.at("recommendations"), 5);
  EXPECT_EQ(figures.at("recommendations_followed"), 4);
  EXPECT_EQ(figures.at("recommendations_ignored"), 1);
  EXPECT_EQ(figures.at("recommendation_followed_before_min_s"), 60);
}

}  // namespace
}  // namespace skein::record::alert_statistics_test
