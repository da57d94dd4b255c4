// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "skein/model/well_clear/band_advisor.h"
#include "skein/model/well_clear/options.h"

namespace skein::model::well_clear_test {
namespace {

const WellClearConfiguration& suas() {
  static const WellClearConfiguration c = *well_clear_configuration("skein_suas");
  return c;
}

// North at 20 m/s, 200 m high.
const AircraftMotion kOwn{Vec3(0, 0, -200), Vec3(20, 0, 0)};

Intruder ahead(double north, double east, double vn, double ve, double above = 0) {
  return {{Vec3(north, east, -200 - above), Vec3(vn, ve, 0)}, 0, 0, 0};
}

TEST(ConflictSpan, HeadOnInACylinder) {
  const ConflictSpan span = conflict_span({600, 75, 0, 0}, {-2000, 0, 0, 40, 0, 0}, 90);
  EXPECT_DOUBLE_EQ(span.in, 35);
  EXPECT_DOUBLE_EQ(span.out, 65);
}

TEST(ConflictSpan, ModifiedTauIsEarlierThanTheCylinder) {
  // (D^2 - s^2) / (s v) = 35 s at s = 1600 m: 1600^2 - 35 * 40 * 1600 - 600^2 < 0.
  const ConflictSpan span = conflict_span({600, 75, 35, 0}, {-2000, 0, 0, 40, 0, 0}, 90);
  const double s = 2000 - 40 * span.in;
  EXPECT_NEAR((600 * 600 - s * s) / (-40 * s), 35, 1e-9);
  EXPECT_LT(span.in, 35);
  EXPECT_DOUBLE_EQ(span.out, 65);
}

TEST(ConflictSpan, HeightCountsAsWellAsDistance) {
  const WellClearVolume volume{600, 75, 0, 0};
  // Descends into it from 200 m above at 2 m/s.
  const ConflictSpan span = conflict_span(volume, {0, 0, 200, 0, 0, -2}, 90);
  EXPECT_DOUBLE_EQ(span.in, 62.5);
  EXPECT_DOUBLE_EQ(span.out, 90);
  EXPECT_FALSE(conflict_span(volume, {0, 0, 200, 0, 0, 2}, 90).conflict());
  EXPECT_FALSE(conflict_span(volume, {0, 0, 100, 0, 0, 0}, 90).conflict());
  EXPECT_FALSE(conflict_span(volume, {0, 0, 0, 0, 0, 0}, -1).conflict());
  // At equal altitude within 30 s: from 60 m above the volume on.
  const WellClearVolume coaltitude{600, 15, 0, 30};
  EXPECT_DOUBLE_EQ(conflict_span(coaltitude, {0, 0, 200, 0, 0, -2}, 90).in, 70);
  EXPECT_TRUE(is_within(coaltitude, {0, 0, 59, 0, 0, -2}));
  EXPECT_FALSE(is_within(coaltitude, {0, 0, 59, 0, 0, 2}));
}

TEST(Configuration, BuiltInsAreGoodAndOthersAreRefused) {
  for (const char* name : {"DO_365B_no_SUM", "skein_suas"})
    EXPECT_TRUE(check(*well_clear_configuration(name)).ok()) << name;
  EXPECT_FALSE(well_clear_configuration("do_365b"));
  WellClearConfiguration bad = suas();
  bad.alerters.push_back(bad.alerters[0]);
  EXPECT_NE(check(bad).error().text().find("is there twice"), std::string::npos);
}

TEST(LevelChange, EndsLevelAtTheAltitudeWithoutJumps) {
  const WellClearConfiguration::Altitude& limits = suas().altitude;
  for (const double vz : {-6.0, -2.0, 0.0, 1.0, 5.0})
    for (const double height : {-300.0, -3.0, 0.0, 0.5, 20.0, 400.0}) {
      const OwnMotion own{200, 20, 0, vz};
      const LevelChange change(own, limits, 200 + height);
      const double end = change.level_at();
      EXPECT_NEAR(change.at(end).z, height, 1e-9);
      EXPECT_NEAR(change.at(end - 1e-9).z, height, 1e-7) << vz << ' ' << height;
      EXPECT_NEAR(change.at(end - 1e-9).vz, 0, 1e-7);
      EXPECT_NEAR(change.at(0).vz, end > 0 ? vz : 0, 1e-12);
      for (double t = 0; t < end; t += 0.01) {
        const ManoeuvrePoint a = change.at(t), b = change.at(t + 0.01);
        EXPECT_LT(std::abs(b.vz - a.vz), 0.01 * limits.accel + 1e-9);
        EXPECT_NEAR(b.z - a.z, 0.01 * (a.vz + b.vz) / 2, 1e-4);
      }
    }
}

TEST(Alerts, RiseWithTimeAndMargins) {
  EXPECT_EQ(alert_level(suas(), kOwn, ahead(3000, 0, -20, 0)), 0);
  EXPECT_EQ(alert_level(suas(), kOwn, ahead(2200, 0, -20, 0)), 2);
  EXPECT_EQ(alert_level(suas(), kOwn, ahead(1300, 0, -20, 0)), 3);
  // 100 m above: within the height of the first level only.
  EXPECT_EQ(alert_level(suas(), kOwn, ahead(1300, 0, -20, 0, 100)), 1);
  Intruder uncertain = ahead(1300, 0, -20, 0, 100);
  uncertain.vertical_margin = 30;
  EXPECT_EQ(alert_level(suas(), kOwn, uncertain), 3);
}

TEST(AlertHysteresis, OneAnswerMakesNoAlertAndForgetsAfterAGap) {
  AlertHysteresis hysteresis;
  const Intruder far = ahead(9000, 0, -20, 0), near = ahead(1300, 0, -20, 0);
  EXPECT_EQ(hysteresis.level(suas(), kOwn, far, 0), 0);
  EXPECT_EQ(hysteresis.level(suas(), kOwn, near, 1), 0);
  EXPECT_EQ(hysteresis.level(suas(), kOwn, far, 2), 0);
  EXPECT_EQ(hysteresis.level(suas(), kOwn, near, 3), 3);
  for (int t = 4; t < 7; ++t) EXPECT_EQ(hysteresis.level(suas(), kOwn, far, t), 3) << t;
  EXPECT_EQ(hysteresis.level(suas(), kOwn, far, 7), 0);
  EXPECT_EQ(hysteresis.level(suas(), kOwn, near, 20), 3) << "the first answer counts";
}

TEST(Bands, OfAnIntruderOnTheRightAreOnTheRight) {
  BandMaker maker(suas());
  const Intruder intruder = ahead(900, 900, 0, -20);
  const ManoeuvreBands& bands = maker.bands(ManoeuvreKind::kTrack, kOwn, {&intruder, 1});
  EXPECT_TRUE(is_corrective(bands.region(0), AlertRegion::kMid));
  const ManoeuvreResolution found = resolution(bands, AlertRegion::kMid);
  ASSERT_TRUE(found.needed && found.up);
  EXPECT_GT(*found.up, 0);
  EXPECT_LT(*found.up, geo::radians(90));
  EXPECT_EQ(bands.region(*found.up), AlertRegion::kNone);
  EXPECT_EQ(bands.region(*found.up + 2 * geo::kPi), AlertRegion::kNone);
}

TEST(Bands, AreFreeWithoutIntruders) {
  BandMaker maker(suas());
  for (std::size_t k = 0; k < kManoeuvreKinds; ++k) {
    const ManoeuvreBands& bands = maker.bands(static_cast<ManoeuvreKind>(k), kOwn, {});
    ASSERT_EQ(bands.pieces.size(), 1u);
    EXPECT_EQ(bands.pieces[0].region, AlertRegion::kNone);
    EXPECT_FALSE(resolution(bands, AlertRegion::kMid).needed);
  }
  AircraftMotion still = kOwn;
  still.v_N.setZero();
  EXPECT_EQ(maker.bands(ManoeuvreKind::kTrack, still, {}).pieces.size(), 1u);
  EXPECT_EQ(maker.bands(ManoeuvreKind::kSpeed, still, {}).pieces[0].lo, 10);
}

TEST(BandAdvisor, KeepsTheSideWhileItIsFree) {
  BandAdvisor advisor(suas());
  const FlightGoal goal{0, 20, 0};
  // A little to the left: pass right of it; then a little to the right.
  TrackedIntruder track{5, ahead(1500, -30, -20, 0).motion, 0, 0, 0};
  const auto first = advisor.advise(0, kOwn, {&track, 1}, goal).track;
  ASSERT_TRUE(first.has_value());
  EXPECT_TRUE(first->up);
  track.motion = ahead(1460, 30, -20, 0).motion;
  const auto second = advisor.advise(1, kOwn, {&track, 1}, goal).track;
  ASSERT_TRUE(second.has_value());
  EXPECT_TRUE(second->up) << "though the left is nearer now";
  BandAdvisor another(suas());
  EXPECT_FALSE(another.advise(1, kOwn, {&track, 1}, goal).track->up);
  // Away: the goal itself, and the side is forgotten.
  track.motion = ahead(-4000, 30, -20, 0).motion;
  const auto third = advisor.advise(2, kOwn, {&track, 1}, goal).track;
  EXPECT_EQ(third->value, 0);
  track.motion = ahead(1460, 30, -20, 0).motion;
  EXPECT_FALSE(advisor.advise(3, kOwn, {&track, 1}, goal).track->up);
}

TEST(BandAdvisor, SaysWhenThereIsOnlyRecovery) {
  BandAdvisor advisor(suas());
  const TrackedIntruder track{5, ahead(400, 0, -20, 0).motion, 0, 0, 0};
  const BandAdvisor::Advice& advice = advisor.advise(0, kOwn, {&track, 1}, {0, 20, 0});
  EXPECT_EQ(advice.alert, 3);
  ASSERT_TRUE(advice.track.has_value());
  EXPECT_EQ(advice.track->region, AlertRegion::kRecovery);
}

}  // namespace
}  // namespace skein::model::well_clear_test
