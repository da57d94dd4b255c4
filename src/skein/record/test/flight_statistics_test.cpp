// SPDX-License-Identifier: Apache-2.0
#include "skein/record/figures/flight_statistics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "skein/record/figures/separation_statistics.h"

namespace skein::record::flight_statistics_test {
namespace {

VehicleState at(double north, double height, bool on_ground = false) {
  VehicleState state;
  state.p_N = Vec3(north, 0, -height);
  state.on_ground = on_ground;
  return state;
}

std::map<std::string, double> figures(const FlightStatistics& statistics) {
  std::map<std::string, double> all;
  statistics.add_figures(all, [](EntityId) { return std::string("a"); });
  return all;
}

TEST(FlightStatistics, CountsWhoStandsOnTheGroundHavingFlown) {
  FlightStatistics statistics;
  const EntityId stands{1}, flies{2}, lands{3}, crashes{4};
  for (int t = 0; t < 6; ++t) {
    const Time time = Time::from_seconds(t);
    statistics.truth(time, stands, at(0, 0, true));
    statistics.truth(time, flies, at(0, 100, t == 1));        // touches, and goes around
    statistics.truth(time, lands, at(0, 0, t > 0 && t < 5));  // on springs
    statistics.truth(time, crashes, at(0, 0, t > 0));
  }
  EXPECT_EQ(figures(statistics).at("aircraft_landed"), 2);
  statistics.event({Time::from_seconds(5), crashes, EventKind::kAccident, "too fast"});
  EXPECT_EQ(figures(statistics).at("aircraft_landed"), 1);
}

TEST(FlightStatistics, WhereNobodyLandsNothingIsSaidAboutIt) {
  FlightStatistics statistics;
  statistics.truth(Time(), EntityId{1}, at(0, 100));
  EXPECT_FALSE(figures(statistics).contains("aircraft_landed"));
}

// Circles at 20 m/s; its estimates are 1 m north of it.
VehicleState circling(double t) {
  VehicleState state;
  state.p_N = Vec3(100 * std::sin(t / 5), -100 * std::cos(t / 5), -50);
  state.v_N = Vec3(20 * std::cos(t / 5), 20 * std::sin(t / 5), 0);
  return state;
}

TEST(FlightStatistics, ComparesEstimatesWithTheTruthAtTheirOwnTimes) {
  FlightStatistics statistics;
  for (int k = 0; k < 100; ++k) {
    const double t = 0.5 * k;
    statistics.truth(Time::from_seconds(t), EntityId{1}, circling(t));
    const double then = std::max(t - 0.37, 0.0);  // as old as telemetry is
    const Vec3 believed = circling(then).p_N + Vec3(1, 0, 0);
    statistics.estimate(Time::from_seconds(then), EntityId{1}, believed, {});
  }
  // The cubic is off by h^4 / 384 times the fourth derivative, 0.03 mm.
  EXPECT_NEAR(figures(statistics).at("position_error_rms_m"), 1, 1e-3);
}

TEST(FlightStatistics, OfWhoNeverSaysAnythingThereIsNoErrorOfPosition) {
  FlightStatistics statistics;
  for (int k = 0; k < 100; ++k) {
    statistics.truth(Time::from_seconds(k), EntityId{1}, circling(k));
    statistics.estimate(Time(), EntityId{1}, circling(0).p_N, {});
  }
  EXPECT_FALSE(figures(statistics).contains("position_error_rms_m"));
}

TEST(FlightStatistics, CountsProgramsThatEndedAndThoseThatAreGone) {
  FlightStatistics statistics;
  EXPECT_FALSE(figures(statistics).contains("outside_programs_ended"));
  statistics.event({Time(), EntityId{1}, EventKind::kAutopilotEnded, "ended with 1"});
  statistics.event({Time(), EntityId{2}, EventKind::kFlightModelEnded, "ended with 1"});
  statistics.event({Time(), EntityId{1}, EventKind::kAutopilotRestarted, "again"});
  EXPECT_EQ(figures(statistics).at("outside_programs_ended"), 2);
  EXPECT_EQ(figures(statistics).at("outside_programs_gone"), 1);
}

SeparationLossRecord loss_of(std::uint32_t other, SeparationPhase phase, double ratio) {
  SeparationLossRecord loss;
  loss.id = EntityId{1};
  loss.other = EntityId{other};
  loss.phase = phase;
  loss.ratio = ratio;
  loss.distance = 50 * ratio;
  return loss;
}

TEST(SeparationStatistics, CountsLossesByPhaseAndPairsInTheAir) {
  SeparationStatistics statistics;
  statistics.loss(loss_of(2, SeparationPhase::kAir, 0.5));
  statistics.loss(loss_of(2, SeparationPhase::kAir, 0.3));
  statistics.loss(loss_of(3, SeparationPhase::kFormation, 0.1));
  statistics.loss(loss_of(4, SeparationPhase::kGround, 0.2));
  std::map<std::string, double> all;
  statistics.add_figures(all, 4);
  EXPECT_EQ(all.at("separation_losses"), 4);
  EXPECT_EQ(all.at("separation_losses_air"), 2);
  EXPECT_EQ(all.at("separation_losses_formation"), 1);
  EXPECT_EQ(all.at("separation_losses_ground"), 1);
  EXPECT_EQ(all.at("violations"), 1);
  EXPECT_EQ(all.at("separation_loss_min_ratio"), 0.1);
  EXPECT_EQ(all.at("separation_loss_min_m"), 5);
  EXPECT_FALSE(all.contains("near_collisions")) << "nobody has said that it keeps apart";
}

TEST(SeparationStatistics, WhoFliesAloneHasNothingToLose) {
  std::map<std::string, double> all;
  SeparationStatistics().add_figures(all, 1);
  EXPECT_TRUE(all.empty());
  SeparationStatistics().add_figures(all, 2);
  EXPECT_EQ(all.at("separation_losses"), 0);
}

TEST(SeparationStatistics, APairKeepsTheLargerSeparation) {
  SeparationStatistics statistics;
  PlanReport wide;
  wide.horizontal = 200;
  wide.vertical = 60;
  statistics.message({EntityId{1}, kEveryone, 0, Time(), PlanReport{}});
  statistics.message({EntityId{2}, kEveryone, 0, Time(), wide});
  for (int t = 0; t < 5; ++t) {
    statistics.truth(Time::from_seconds(t), EntityId{1}, at(0, 400));
    statistics.truth(Time::from_seconds(t), EntityId{2}, at(300, 400));
  }
  std::map<std::string, double> all;
  statistics.add_figures(all, 2);
  EXPECT_NEAR(all.at("separation_min_ratio"), 1.5, 1e-9);
}

TEST(SeparationStatistics, WhoIsOnTheGroundIsNotToBeKeptApartFrom) {
  SeparationStatistics statistics;
  statistics.message({EntityId{1}, kEveryone, 0, Time(), PlanReport{}});
  for (int t = 0; t < 5; ++t) {
    statistics.truth(Time::from_seconds(t), EntityId{1}, at(20 * t - 40, 15));
    statistics.truth(Time::from_seconds(t), EntityId{2}, at(0, 0, t != 2));
  }
  std::map<std::string, double> all;
  statistics.add_figures(all, 2);
  EXPECT_FALSE(all.contains("separation_min_ratio")) << "landing gear springs";
}

}  // namespace
}  // namespace skein::record::flight_statistics_test
