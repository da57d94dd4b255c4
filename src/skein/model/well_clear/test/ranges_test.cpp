// SPDX-License-Identifier: Apache-2.0
// Which ranges of values count: within the limits, wider than rounding, and those that
// regain well clear.
#include <gtest/gtest.h>

#include "skein/model/well_clear/bands.h"

namespace skein::model::ranges_test {
namespace {

const WellClearConfiguration& configuration(const char* name) {
  static const WellClearConfiguration suas = *well_clear_configuration("skein_suas");
  static const WellClearConfiguration do365 = *well_clear_configuration("DO_365B_no_SUM");
  return name == suas.name ? suas : do365;
}

AircraftMotion motion(Vec3 p_N, Vec3 v_N) {
  return {p_N, v_N};
}

// The ends of pieces, from the lowest to the highest, and what lies between.
void expect_bands(const ManoeuvreBands& bands, std::vector<double> ends,
                  std::vector<AlertRegion> regions) {
  ASSERT_EQ(bands.pieces.size(), regions.size());
  for (std::size_t i = 0; i < regions.size(); ++i) {
    EXPECT_NEAR(bands.pieces[i].lo, ends[i], 1e-6) << i;
    EXPECT_NEAR(bands.pieces[i].hi, ends[i + 1], 1e-6) << i;
    EXPECT_EQ(bands.pieces[i].region, regions[i]) << i;
  }
}

constexpr auto kNone = AlertRegion::kNone, kMid = AlertRegion::kMid,
               kNear = AlertRegion::kNear, kRecovery = AlertRegion::kRecovery;

// Level, 60 steps below the limit but for rounding: one more step lies at the limit, and
// beyond it the conflict ends. Case do365-p0173 of the reference.
TEST(Ranges, AreNotAsNarrowAsRounding) {
  BandMaker maker(configuration("DO_365B_no_SUM"));
  const Intruder intruder{motion({8138.52, -4645.87, -3645.08}, {-36.219, 38.690, 6.811}),
                          0, 0, 0};
  expect_bands(maker.bands(ManoeuvreKind::kVerticalSpeed,
                           motion({2835.61, 933.61, -2993.21}, {46.280, -48.636, 0}),
                           {&intruder, 1}),
               {-30.48, 2.032, 11.176, 30.48}, {kNone, kMid, kNear});
}

// The range to the limit is 4 mm/s wide: what it alone regains is no recovery.
TEST(Ranges, OfAFewMillimetresASecondMakeNoRecovery) {
  BandMaker maker(configuration("skein_suas"));
  const Intruder intruder{motion({-864.22, 623.62, -104.4}, {20.412, -28.093, 0.308}), 0,
                          0, 0};
  const ManoeuvreBands& bands =
      maker.bands(ManoeuvreKind::kSpeed,
                  motion({0, 0, -128.82}, {-25.438, -23.3, -0.895}), {&intruder, 1});
  expect_bands(bands, {10, 36.99611346, 40}, {kNear, kRecovery});
  EXPECT_NEAR(bands.recovery.time, 24.09375, 1e-9);
}

TEST(Ranges, OfTracksEndAtNorthWithoutSlivers) {
  BandMaker maker(configuration("skein_suas"));
  const Intruder intruder{motion({2113.17, -1546.32, -186.25}, {-28.398, 21.957, -1.398}),
                          0, 0, 0};
  expect_bands(
      maker.bands(ManoeuvreKind::kTrack,
                  motion({0, 0, -316.92}, {15.678, 16.795, -0.064}), {&intruder, 1}),
      {0, 4.834039693, 2 * geo::kPi}, {kNone, kMid});
}

TEST(Ranges, OfWholeDegreesAreNoneOfRounding) {
  for (const char* name : {"skein_suas", "DO_365B_no_SUM"}) {
    BandMaker maker(configuration(name));
    for (int degrees = 0; degrees < 360; ++degrees) {
      const double course = geo::radians(degrees), speed = 20;
      const Vec3 ahead(math::cos(course), math::sin(course), 0);
      const AircraftMotion own = motion({0, 0, -200}, speed * ahead);
      const Intruder intruder{motion(Vec3(0, 0, -200) + 1500 * ahead, -speed * ahead), 0,
                              0, 0};
      for (std::size_t k = 0; k < kManoeuvreKinds; ++k)
        for (const BandPiece& piece :
             maker.bands(static_cast<ManoeuvreKind>(k), own, {&intruder, 1}).pieces)
          EXPECT_GT(piece.hi - piece.lo, same(piece.hi))
              << name << ' ' << k << ' ' << degrees;
    }
  }
}

TEST(Ranges, OfOneStepAreThereWhereLimitsAreNear) {
  WellClearConfiguration narrow = configuration("skein_suas");
  narrow.speed.max = narrow.speed.min + 1e-4;
  BandMaker maker(narrow);
  const ManoeuvreBands& bands =
      maker.bands(ManoeuvreKind::kSpeed, motion({0, 0, -200}, {20, 0, 0}), {});
  expect_bands(bands, {narrow.speed.min, narrow.speed.max}, {kNone});
}

// The climb to 100 m ends 90 s from now, and is within the volume in that second only.
TEST(Ranges, NothingCountsAtTheLookahead) {
  BandMaker maker(configuration("skein_suas"));
  const Intruder intruder{motion({1742.92, -2271.04, -403.41}, {-11.992, 29.727, 2.827}),
                          0, 0, 0};
  expect_bands(maker.bands(ManoeuvreKind::kAltitude,
                           motion({0, 0, -369.51}, {11.359, 8.364, 0}), {&intruder, 1}),
               {30, 100, 210, 260, 1500}, {kNone, kNear, kMid, kNone});
}

// The first intruder is in conflict now, the second for some altitudes only: beyond its
// window of 45 s, distances to it count while levelling off, too.
TEST(Recovery, KeepsDistancesBeyondTheWindowOfAnIntruder) {
  BandMaker maker(configuration("skein_suas"));
  const Intruder intruders[] = {
      {motion({-318.62, -770.06, -273.17}, {17.628, 20.46, 0}), 0, 0, 0},
      {motion({2376.78, 1320.56, -431.59}, {-32.425, -32.629, 0}), 0, 0, 0}};
  const ManoeuvreBands& bands = maker.bands(
      ManoeuvreKind::kAltitude, motion({0, 0, -322.42}, {9.276, -11.548, 0}), intruders);
  expect_bands(bands, {30, 320, 380, 490, 1500}, {kNear, kRecovery, kNear, kRecovery});
  EXPECT_EQ(bands.recovery.shrunk, 0);
}

// Case suas-m0080 of the reference, which shrinks the distances three times: it takes -1
// and 4 for equal (docs/well-clear.md). Shrunk twice they are kept, by stepping along.
TEST(Recovery, ShrinksDistancesNoMoreThanNeeded) {
  const WellClearConfiguration& c = configuration("skein_suas");
  BandMaker maker(c);
  const AircraftMotion own = motion({3588.26, 973.93, -152.94}, {-8.981, 12.396, 0});
  std::vector<Intruder> intruders;
  for (const AircraftMotion& each :
       {motion({3682.47, 1692.72, -303.69}, {-47.614, -14.336, 0}),
        motion({3464.49, 708.75, -111.69}, {7.876, 4.528, 0}),
        motion({3480.05, 775.91, -102.99}, {9.767, 11.461, 0}),
        motion({3776.12, 1151.55, -162.07}, {2.426, -3.209, 1.449}),
        motion({4983.71, 4503.77, -244.57}, {-40.333, -34.484, -0.571}),
        motion({3019.72, 747.53, -89.36}, {10.365, 12.097, 0}),
        motion({2998.71, 686.57, -290.22}, {-7.258, 10.071, 2.909})})
    intruders.push_back({each, 0, 0, 0});
  const ManoeuvreBands& bands =
      maker.bands(ManoeuvreKind::kVerticalSpeed, own, intruders);
  expect_bands(bands, {-4, 3, 4}, {kNear, kRecovery});
  EXPECT_EQ(bands.recovery.shrunk, 2);
  EXPECT_NEAR(bands.recovery.time, 20.9297, 6e-5);
  const WellClearVolume kept{bands.recovery.horizontal, bands.recovery.vertical, 0, 0};
  for (const double climb : {3.0, 4.0})
    for (const Intruder& intruder : intruders)
      for (double t = 0; t < c.lookahead; t += 0.01) {
        const double taken_up = std::min(t, climb / c.vertical_speed.accel);
        const double z = climb * t - taken_up * (climb - taken_up / 2);
        const ManoeuvrePoint p{
            t, own.v_N.x() * t, own.v_N.y() * t, z, own.v_N.x(), own.v_N.y(), climb};
        const RelativeMotion between =
            relative_motion(own_motion(own), p, intruder_motion(own, intruder));
        EXPECT_FALSE(is_within(
            t < bands.recovery.time ? kept : c.alerters[0].levels[1].volume, between))
            << climb << ' ' << t;
      }
}

// The faster speeds are the first to be clear of the aircraft behind, 11 s from now, and
// the first to come too near to the one that crosses ahead, before the stability time is
// over; the slower ones are clear when it is. The volume about the one ahead is smaller
// than the distances.
TEST(Recovery, IsNotLostWithinTheStabilityTime) {
  const WellClearConfiguration& c = configuration("DO_365B_no_SUM");
  ManoeuvreOptions options(c, ManoeuvreKind::kSpeed);
  options.start({3000, 100, 0, 0});
  RecoverySearch recovery(c);
  recovery.start(options.count());
  const IntruderMotion behind{-1000, 0, 3000, 90, 0, 0};
  const IntruderMotion ahead{1035, -2700, 3000, 100, 200, 0};
  std::vector<OptionSpan> spans(options.count());
  for (const auto& [intruder, radius] :
       {std::pair{behind, 1222.32}, std::pair{ahead, 457.2}}) {
    options.survey({radius, 137.16, 0, 0}, intruder, c.lookahead, StepRule::kUntilNext,
                   spans);
    recovery.add(intruder, 0, 0, c.lookahead, options, spans);
  }
  const BandRecovery found = recovery.search(options);
  ASSERT_EQ(found.outcome, BandRecovery::Outcome::kFound);
  EXPECT_EQ(found.shrunk, 3) << "twice is enough at 11 s, not at 14 s";
  bool any = false;
  for (std::size_t i = options.first_range(); i < options.end_of_ranges(); ++i)
    any = any || (recovery.regains(i) && recovery.regains(i + 1));
  EXPECT_TRUE(any);
}

}  // namespace
}  // namespace skein::model::ranges_test
