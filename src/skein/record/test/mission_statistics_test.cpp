// SPDX-License-Identifier: Apache-2.0
#include "skein/record/figures/mission/mission_statistics.h"

#include <gtest/gtest.h>

#include <cmath>

#include "skein/geo/rotation.h"

namespace skein::record::mission_statistics_test {
namespace {

const EntityId kStation{0}, kAircraft{1};

Time at(double seconds) {
  return Time::from_seconds(seconds);
}

MissionRecord change(double time, MissionState state, MissionGoal goal) {
  return {at(time), kStation, {"m", state, std::move(goal)}};
}

std::map<std::string, double> figures(const MissionStatistics& statistics) {
  std::map<std::string, double> all;
  statistics.add_figures(all);
  return all;
}

// Flies straight from one place to another, as truths of every second.
void fly(MissionStatistics& statistics, double& time, const Vec2& from, const Vec2& to,
         double speed = 20) {
  const int steps = static_cast<int>((to - from).norm() / speed);
  for (int k = 0; k <= steps; ++k) {
    const Vec2 p = from + (to - from) * k / steps;
    statistics.truth(at(time), kAircraft, {p.x(), p.y(), -100});
    time += 1;
  }
}

SurveyGoal square() {
  return {{{0, 0}, {1000, 0}, {1000, 1000}, {0, 1000}}, {}, 100};
}

TEST(SurveyFigures, CountTheAreaWithinHalfASwathOfTheTruePath) {
  MissionStatistics statistics;
  statistics.mission(change(0, MissionState::kBegun, square()));
  double time = 0;
  fly(statistics, time, {-200, 50}, {1200, 50});
  // A strip of 100 m of 1000: the raster has 6.25 m.
  EXPECT_NEAR(figures(statistics)["mission_m_seen"], 0.1, 0.004);
  fly(statistics, time, {1200, 500}, {-200, 500});
  EXPECT_NEAR(figures(statistics)["mission_m_seen"], 0.2, 0.008);
  EXPECT_FALSE(figures(statistics).contains("mission_m_seen_95_s"));
}

TEST(SurveyFigures, CompareTheTimeWithThePlan) {
  MissionStatistics statistics;
  SurveyGoal goal = square();
  goal.holes = {{{100, 0}, {1000, 0}, {1000, 1000}, {100, 1000}}};  // all but a strip
  statistics.mission(change(100, MissionState::kBegun, goal));
  EXPECT_FALSE(figures(statistics).contains("mission_m_planned_s"));
  // Planned 20 s later, to take 90 s.
  goal.planned_at = 120;
  goal.planned_for = 90;
  statistics.mission(change(120, MissionState::kChanged, goal));
  double time = 120;
  fly(statistics, time, {50, -100}, {50, 1100}, 10);
  const auto all = figures(statistics);
  EXPECT_EQ(all.at("mission_m_planned_s"), 90);
  ASSERT_TRUE(all.contains("mission_m_seen_all_s"));
  EXPECT_NEAR(all.at("mission_m_seen_all_of_plan"),
              (all.at("mission_m_seen_all_s") - 20) / 90, 1e-9);
}

TEST(SurveyFigures, LeaveOutHolesAndSayWhenAllWasSeen) {
  MissionStatistics statistics;
  SurveyGoal goal = square();
  goal.holes = {{{100, 0}, {1000, 0}, {1000, 1000}, {100, 1000}}};  // all but a strip
  statistics.mission(change(100, MissionState::kBegun, goal));
  double time = 100;
  fly(statistics, time, {50, -100}, {50, 600}, 10);
  EXPECT_NEAR(figures(statistics)["mission_m_seen"], 0.65, 0.01);
  fly(statistics, time, {50, 600}, {50, 1100}, 10);
  const auto all = figures(statistics);
  EXPECT_EQ(all.at("mission_m_seen"), 1);
  EXPECT_NEAR(all.at("mission_m_seen_95_s"), 101, 3);  // at 1,000 - 50 - 50 m of it
  EXPECT_NEAR(all.at("mission_m_seen_all_s"), 107, 4);
  EXPECT_EQ(all.at("mission_m_begun_s"), 100);
}

TEST(SurveyFigures, NothingIsSeenOnTheGroundBeforeOrAfterTheMission) {
  MissionStatistics statistics;
  double time = 0;
  fly(statistics, time, {50, 0}, {50, 1000});
  statistics.mission(change(time, MissionState::kBegun, square()));
  statistics.estimate(at(time), kAircraft, {50, 1000, 0}, true);
  fly(statistics, time, {50, 1000}, {50, 0});
  EXPECT_EQ(figures(statistics)["mission_m_seen"], 0);
  statistics.estimate(at(time), kAircraft, {50, 0, -100}, false);
  statistics.mission(change(time, MissionState::kPaused, square()));
  fly(statistics, time, {50, 0}, {50, 1000});
  EXPECT_EQ(figures(statistics)["mission_m_seen"], 0);
  statistics.mission(change(time, MissionState::kResumed, square()));
  fly(statistics, time, {50, 1000}, {50, 0});
  EXPECT_NEAR(figures(statistics)["mission_m_seen"], 0.1, 0.004);
  statistics.mission(change(time, MissionState::kOver, square()));
  const double over = time;
  fly(statistics, time, {500, 0}, {500, 1000});
  EXPECT_NEAR(figures(statistics)["mission_m_seen"], 0.1, 0.004);
  EXPECT_NEAR(figures(statistics)["mission_m_took_s"], over - 51, 1);
}

TEST(SurveyFigures, OfAircraftWithoutATruthTheEstimateCounts) {
  MissionStatistics statistics;
  statistics.mission(change(0, MissionState::kBegun, square()));
  for (int k = 0; k <= 60; ++k)
    statistics.estimate(at(k), kAircraft, {20.0 * k - 100, 50, -100}, false);
  EXPECT_NEAR(figures(statistics)["mission_m_seen"], 0.1, 0.004);
}

TEST(TrackFigures, CountTimeInPicturesFromTheFirstDetectionAndErrorsOfTheBelief) {
  MissionStatistics statistics;
  statistics.motion({at(0), 3, {0, 0}, {1, 0}});
  statistics.motion({at(0), 4, {5000, 0}, {0, 0}});  // never found
  statistics.mission(change(0, MissionState::kBegun, TrackGoal{}));
  for (int k = 0; k <= 200; ++k) {
    const double t = k;
    statistics.truth(at(t), kAircraft, {t, 0, -100});
    // From 20 s on it is in the picture, which is 40 m wide, but for 30 s.
    const double north = t < 20 || (t >= 100 && t < 130) ? t + 100 : t;
    statistics.footprint({at(t),
                          kAircraft,
                          0,
                          {Vec2(north + 20, -20), Vec2(north + 20, 20),
                           Vec2(north - 20, 20), Vec2(north - 20, -20)}});
    if (k == 20) statistics.detection({at(t), kAircraft, 0, 3, {t, 1}, 2});
    if (k > 20)
      statistics.belief(
          {at(t), kStation, {3, at(t - 2), {t - 2, 6}, {1, 0}, 1, 1, 1e9, "m"}});
  }
  const auto all = figures(statistics);
  EXPECT_EQ(all.at("mission_m_found"), 1);
  // 2 s of the 30 are within the time of the last picture before.
  EXPECT_NEAR(all.at("mission_m_in_view"), 1 - 28.0 / 180, 0.012);
  EXPECT_EQ(all.at("mission_m_in_view"), all.at("mission_m_in_view_worst"));
  EXPECT_NEAR(all.at("mission_m_error_rms_m"), 6, 1e-9);
}

TEST(PatrolFigures, MeasureTheTimeBetweenVisits) {
  MissionStatistics statistics;
  statistics.mission(change(0, MissionState::kBegun,
                            PatrolGoal{{{0, 0}, {1000, 0}, {2000, 0}}, false, 50}));
  double time = 0;
  fly(statistics, time, {0, 10}, {1000, 10});
  EXPECT_NEAR(figures(statistics)["mission_m_visited"], 0.525, 0.03);
  EXPECT_FALSE(figures(statistics).contains("mission_m_revisit_mean_s"));
  fly(statistics, time, {1000, 10}, {2000, 10});
  fly(statistics, time, {2000, 10}, {0, 10});
  const auto all = figures(statistics);
  EXPECT_EQ(all.at("mission_m_visited"), 1);
  // There and back: from nothing at the far end to 200 s at the near one.
  EXPECT_NEAR(all.at("mission_m_revisit_max_s"), 200, 8);
  EXPECT_NEAR(all.at("mission_m_revisit_mean_s"), 100, 12);
  EXPECT_NEAR(all.at("mission_m_age_max_s"), 102, 8);
}

TEST(MissionStatistics, GiveASeriesEveryTenSecondsAndAtTheEnd) {
  MissionStatistics statistics;
  statistics.mission(change(0, MissionState::kBegun, square()));
  double time = 0;
  fly(statistics, time, {0, 50}, {1000, 50});
  statistics.mission(change(time, MissionState::kOver, square()));
  const auto series = statistics.take_series();
  ASSERT_EQ(series.size(), 7u);  // at 0, 10 ... 50 s and at the end
  EXPECT_EQ(series[3].time, at(30));
  EXPECT_EQ(series[3].mission, "m");
  EXPECT_EQ(series[3].figures[0].name, "seen");
  EXPECT_NEAR(series[3].figures[0].value, 0.06, 0.006);
  EXPECT_EQ(series.back().time, at(time));
  EXPECT_TRUE(statistics.take_series().empty());
}

// Leader 1 flies north at 20 m/s; 2 keeps its place 30 m behind to the right, 3 is
// always `off` metres further behind than its place to the left.
void fly_formation(MissionStatistics& statistics, double from, double until, double off) {
  for (double time = from; time <= until; time += 1) {
    const double north = 20 * time;
    statistics.truth(at(time), {1}, {north, 0, -100});
    statistics.truth(at(time), {2}, {north - 30, 30, -100});
    statistics.truth(at(time), {3}, {north - 30 - off, -30, -100});
  }
}

TEST(FormationFigures, MeasureTheDistanceFromPlacesBesideTheLeader) {
  MissionStatistics statistics;
  const FormationGoal goal{{1}, {{2}, {3}}, {{-30, 30}, {-30, -30}}};
  statistics.mission(change(0, MissionState::kBegun, goal));
  fly_formation(statistics, 0, 100, 10);
  auto all = figures(statistics);
  EXPECT_NEAR(all["mission_m_slot_error_mean_m"], 5, 0.01);
  EXPECT_NEAR(all["mission_m_slot_error_95_m"], 10, 0.01);
  EXPECT_NEAR(all["mission_m_in_place"], 1, 1e-9);
  EXPECT_NEAR(all["mission_m_apart_min_m"], std::hypot(30, 30), 0.01);
  // Then 3 is 50 m off for as long: half of its time.
  fly_formation(statistics, 101, 201, 50);
  all = figures(statistics);
  EXPECT_NEAR(all["mission_m_slot_error_max_m"], 50, 0.01);
  EXPECT_NEAR(all["mission_m_in_place"], 0.75, 0.01);
}

TEST(FormationFigures, BelongToTheLeaderOfTheTime) {
  MissionStatistics statistics;
  statistics.mission(
      change(0, MissionState::kBegun, FormationGoal{{1}, {{2}}, {{-30, 30}}}));
  fly_formation(statistics, 0, 50, 0);
  // 2 leads from now on: 1 is where it should be, ahead of 2 and to its left.
  statistics.mission(
      change(50, MissionState::kChanged, FormationGoal{{2}, {{1}}, {{30, -30}}}));
  fly_formation(statistics, 51, 100, 0);
  EXPECT_NEAR(figures(statistics)["mission_m_slot_error_max_m"], 0, 0.01);
}

TEST(FormationFigures, LeaveOutWhoTakesNoFurtherPart) {
  MissionStatistics statistics;
  const FormationGoal goal{{1}, {{2}, {3}}, {{-30, 30}, {-30, -30}}};
  statistics.mission(change(0, MissionState::kBegun, goal));
  fly_formation(statistics, 0, 50, 0);
  statistics.event({at(50), {3}, EventKind::kLeft, ""});
  for (double time = 51; time <= 100; time += 1) {
    statistics.truth(at(time), {1}, {20 * time, 0, -100});
    statistics.truth(at(time), {2}, {20 * time - 30, 30, -100});
  }
  EXPECT_NEAR(figures(statistics)["mission_m_slot_error_max_m"], 0, 0.01);
}

TEST(FormationFigures, NobodyIsInPlaceWhileTheLeaderIsGone) {
  MissionStatistics statistics;
  const FormationGoal goal{{1}, {{2}, {3}}, {{-30, 30}, {-30, -30}}};
  statistics.mission(change(0, MissionState::kBegun, goal));
  fly_formation(statistics, 0, 50, 0);
  statistics.event({at(50), {1}, EventKind::kLeft, ""});
  for (double time = 51; time <= 100; time += 1) {
    statistics.truth(at(time), {2}, {20 * time - 30, 30, -100});
    statistics.truth(at(time), {3}, {20 * time - 30, -30, -100});
  }
  EXPECT_NEAR(figures(statistics)["mission_m_in_place"], 0.5, 0.02);
  // Then 2 leads, and 3 is 60 m off its new place until it has come there.
  statistics.mission(
      change(100, MissionState::kChanged, FormationGoal{{2}, {{3}}, {{0, -120}}}));
  for (double time = 101; time <= 150; time += 1) {
    statistics.truth(at(time), {2}, {20 * time - 30, 30, -100});
    statistics.truth(at(time), {3}, {20 * time - 30, -30, -100});
  }
  EXPECT_NEAR(figures(statistics)["mission_m_slot_error_max_m"], 60, 0.01);
  EXPECT_NEAR(figures(statistics)["mission_m_in_place"], 0.42, 0.03);
}

TEST(FormationFigures, DoNotCountAFollowerThatHasNotArrived) {
  MissionStatistics statistics;
  statistics.mission(
      change(0, MissionState::kBegun, FormationGoal{{1}, {{3}}, {{-30, -30}}}));
  fly_formation(statistics, 0, 50, 200);
  EXPECT_FALSE(figures(statistics).contains("mission_m_slot_error_mean_m"));
  EXPECT_FALSE(figures(statistics).contains("mission_m_apart_min_m"));
}

}  // namespace
}  // namespace skein::record::mission_statistics_test
