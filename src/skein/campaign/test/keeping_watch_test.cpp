// SPDX-License-Identifier: Apache-2.0
#include "skein/campaign/keeping/keeping_watch.h"

#include <gtest/gtest.h>

#include "skein/base/random.h"

namespace skein::campaign::keeping_watch_test {
namespace {

constexpr EntityId kAircraft{1};

std::map<std::string, double> figures_of(const KeepingWatch& watch) {
  std::map<std::string, double> figures;
  watch.add_figures(figures);
  return figures;
}

TEST(KeepingWatch, MeasuresTheTrueDistanceAcrossALegOfAnyCourse) {
  RandomStream random(1, 0, Purpose::kTest);
  for (int trial = 0; trial < 50; ++trial) {
    const double course = random.uniform(-3, 3), off = random.uniform(-9, 9);
    const Vec2 along = geo::unit(course);
    const Vec2 wrong(random.uniform(-9, 9), random.uniform(-9, 9));
    KeepingWatch watch({kAircraft, 100, 15, std::nullopt, 1});
    VehicleState state;
    NavEstimate nav;
    AutopilotStatus status;
    status.follows = true;
    status.along = along;
    state.airspeed = 16;
    for (int k = 0; k < 100; ++k) {
      const Vec2 place = 1.5 * k * along + off * geo::turned_right(along);
      state.p_N = {place.x(), place.y(), -103};
      nav.p_N = state.p_N + Vec3(wrong.x(), wrong.y(), 0);
      status.cross_track = off + geo::turned_right(along).dot(wrong);
      watch.record(TruthRecord{Time::from_seconds(0.1 * k), kAircraft, state});
      watch.record(EstimateRecord{kAircraft, nav, status});
    }
    const auto figures = figures_of(watch);
    EXPECT_NEAR(figures.at("straights_rms_m"), std::abs(off), 1e-9);
    EXPECT_NEAR(figures.at("believed_rms_m"), std::abs(status.cross_track), 1e-9);
    EXPECT_NEAR(figures.at("height_max_m"), 3, 1e-9);
    EXPECT_NEAR(figures.at("airspeed_rms_mps"), 1, 1e-9);
    EXPECT_EQ(figures.count("turns_rms_m"), 0u);
    EXPECT_EQ(figures.count("hover_max_m"), 0u);
  }
}

TEST(KeepingWatch, DistinguishesTurnsFromStraightsAndWatchesAHover) {
  KeepingWatch turning({kAircraft, 100, 15, std::nullopt, 1});
  AutopilotStatus status;
  status.follows = true;
  status.cross_track = 2;
  for (int k = 0; k < 100; ++k) {
    status.along = geo::unit(0.02 * k);
    turning.record(TruthRecord{Time::from_seconds(0.1 * k), kAircraft, {}});
    turning.record(EstimateRecord{kAircraft, {}, status});
  }
  EXPECT_NEAR(figures_of(turning).at("turns_rms_m"), 2, 1e-9);
  EXPECT_EQ(figures_of(turning).count("straights_rms_m"), 0u);

  KeepingWatch hovering({kAircraft, 100, 15, Vec2(3, 4), 1});
  VehicleState state;
  state.p_N = {3, 4, -102};
  hovering.record(TruthRecord{Time::from_seconds(2), kAircraft, state});
  hovering.record(EstimateRecord{kAircraft, {}, {}});
  EXPECT_NEAR(figures_of(hovering).at("hover_max_m"), 2, 1e-9);
  EXPECT_EQ(figures_of(hovering).at("accident"), 0);
  hovering.record(Event{Time(), kAircraft, EventKind::kAccident, ""});
  EXPECT_EQ(figures_of(hovering).at("accident"), 1);
}

}  // namespace
}  // namespace skein::campaign::keeping_watch_test
