// SPDX-License-Identifier: Apache-2.0
// What holds for all encounters, whatever another program says.
#include <rapidcheck.h>

#include <gtest/gtest.h>

#include "skein/base/random.h"
#include "skein/model/well_clear/band_advisor.h"
#include "skein/model/well_clear/test/random_encounter.h"

namespace skein::model::test::well_clear_property_test {
namespace {

const WellClearConfiguration& configuration_of(int choice) {
  static const WellClearConfiguration both[] = {
      *well_clear_configuration("DO_365B_no_SUM"),
      *well_clear_configuration("skein_suas")};
  return both[choice];
}

// Whether t is within the span, but for a margin about its ends.
bool clearly_within(const ConflictSpan& span, double t) {
  constexpr double kMargin = 1e-6;
  return span.conflict() && t > span.in + kMargin && t < span.out - kMargin;
}

TEST(WellClearLaw, ASpanIsWhenSteppingAlongIsWithinTheVolume) {
  EXPECT_TRUE(rc::check([] {
    RandomEncounter random(*rc::gen::inRange(0, 1 << 30));
    const WellClearVolume volume{300 + 500 * random.uniform(), 40 + 60 * random.uniform(),
                                 random.uniform() < 0.5 ? 0 : 40 * random.uniform(), 0};
    const AircraftMotion own = random.aircraft(2000, 200);
    const Intruder intruder{random.aircraft(2000, 200), 0, 0, 0};
    const OwnMotion o = own_motion(own);
    const IntruderMotion i = intruder_motion(own, intruder);
    constexpr double kHorizon = 90;
    const ConflictSpan span = conflict_span(
        volume, relative_motion(o, {0, 0, 0, 0, o.vx, o.vy, o.vz}, i), kHorizon);
    for (double t = 0; t < kHorizon; t += 0.37) {
      const RelativeMotion at =
          relative_motion(o, {t, o.vx * t, o.vy * t, o.vz * t, o.vx, o.vy, o.vz}, i);
      if (clearly_within(span, t)) RC_ASSERT(is_within(volume, at));
      const bool near_an_end =
          span.conflict() && t > span.in - 1e-6 && t < span.out + 1e-6;
      if (!near_an_end) RC_ASSERT(!is_within(volume, at));
    }
  }));
}

TEST(WellClearLaw, AlertsAndBandsDoNotDependOnWhereNorthIsNorOnTheOrigin) {
  EXPECT_TRUE(rc::check([] {
    RandomEncounter random(*rc::gen::inRange(0, 1 << 30));
    const WellClearConfiguration& c = configuration_of(*rc::gen::inRange(0, 2));
    const AircraftMotion own = random.aircraft(1000, 100);
    std::vector<Intruder> intruders = random.intruders(3, c);
    // Turned by quarters and moved by powers of two: without rounding.
    const Vec3 moved(4096, -8192, 0);
    const auto turn = [](const Vec3& v) { return Vec3(-v.y(), v.x(), v.z()); };
    const auto turned = [&](const AircraftMotion& m) {
      return AircraftMotion{turn(m.p_N) + moved, turn(m.v_N)};
    };
    std::vector<Intruder> others = intruders;
    for (Intruder& each : others) each.motion = turned(each.motion);
    for (std::size_t i = 0; i < intruders.size(); ++i)
      RC_ASSERT(alert_level(c, own, intruders[i]) ==
                alert_level(c, turned(own), others[i]));
    BandMaker maker(c), turned_maker(c);
    for (const ManoeuvreKind kind :
         {ManoeuvreKind::kSpeed, ManoeuvreKind::kVerticalSpeed, ManoeuvreKind::kAltitude})
      RC_ASSERT(maker.bands(kind, own, intruders).pieces.size() ==
                turned_maker.bands(kind, turned(own), others).pieces.size());
    const ManoeuvreBands& here = maker.bands(ManoeuvreKind::kTrack, own, intruders);
    const ManoeuvreBands& there =
        turned_maker.bands(ManoeuvreKind::kTrack, turned(own), others);
    // In the middle of the values of steps, where rounding decides nothing.
    for (double k = -179.5; k < 180; ++k) {
      const double track = here.own + geo::radians(k);
      RC_ASSERT(here.region(track) == there.region(track + geo::kPi / 2));
    }
  }));
}

TEST(WellClearLaw, LargerVolumesAlertNoLaterAndFreeNoMore) {
  EXPECT_TRUE(rc::check([] {
    RandomEncounter random(*rc::gen::inRange(0, 1 << 30));
    const WellClearConfiguration& c = configuration_of(*rc::gen::inRange(0, 2));
    const AircraftMotion own = random.aircraft(1000, 100);
    const std::vector<Intruder> intruders = random.intruders(2, c);
    std::vector<Intruder> wider = intruders;
    for (Intruder& each : wider) {
      each.horizontal_margin = 200 * random.uniform();
      each.vertical_margin = 50 * random.uniform();
    }
    for (std::size_t i = 0; i < intruders.size(); ++i)
      RC_ASSERT(alert_level(c, own, wider[i]) >= alert_level(c, own, intruders[i]));
    BandMaker maker(c), wide_maker(c);
    for (std::size_t k = 0; k < kManoeuvreKinds; ++k) {
      const auto kind = static_cast<ManoeuvreKind>(k);
      const ManoeuvreBands& wide = wide_maker.bands(kind, own, wider);
      const ManoeuvreBands& bands = maker.bands(kind, own, intruders);
      for (const BandPiece& piece : wide.pieces)
        if (piece.region == AlertRegion::kNone)
          RC_ASSERT(bands.region((piece.lo + piece.hi) / 2) == AlertRegion::kNone);
    }
  }));
}

TEST(WellClearLaw, PiecesCoverTheRangeInOrder) {
  EXPECT_TRUE(rc::check([] {
    RandomEncounter random(*rc::gen::inRange(0, 1 << 30));
    const WellClearConfiguration& c = configuration_of(*rc::gen::inRange(0, 2));
    BandMaker maker(c);
    const std::vector<Intruder> intruders = random.intruders(*rc::gen::inRange(0, 6), c);
    const AircraftMotion own = random.aircraft(1000, 300);
    const double lows[] = {0, c.speed.min, c.vertical_speed.min, c.altitude.min};
    const double highs[] = {2 * geo::kPi, c.speed.max, c.vertical_speed.max,
                            c.altitude.max};
    for (std::size_t k = 0; k < kManoeuvreKinds; ++k) {
      const ManoeuvreBands& bands =
          maker.bands(static_cast<ManoeuvreKind>(k), own, intruders);
      RC_ASSERT(bands.pieces.front().lo == lows[k]);
      RC_ASSERT(bands.pieces.back().hi == highs[k]);
      for (std::size_t i = 0; i < bands.pieces.size(); ++i) {
        RC_ASSERT(bands.pieces[i].hi - bands.pieces[i].lo > same(bands.pieces[i].hi));
        if (i == 0) continue;
        RC_ASSERT(bands.pieces[i].lo == bands.pieces[i - 1].hi);
        RC_ASSERT(bands.pieces[i].region != bands.pieces[i - 1].region);
      }
      if (intruders.empty()) RC_ASSERT(bands.pieces.size() == 1u);
    }
  }));
}

// Least ratio of distances to the volume's while a value is taken up and flown for
// `window`, by stepping along with another integration than that of options.
bool meets(const WellClearConfiguration& c, const AircraftMotion& own,
           const Intruder& intruder, ManoeuvreKind kind, double value, double window) {
  const WellClearVolume& volume = c.alerters[intruder.alerter].levels[1].volume;
  const OwnMotion o = own_motion(own);
  const IntruderMotion i = intruder_motion(own, intruder);
  constexpr double kStep = 0.002;  // [s]
  double course = math::atan2(o.vy, o.vx), vz = o.vz;
  double speed = math::hypot(o.vx, o.vy);
  const auto towards = [](double from, double to, double most) {
    return from + std::clamp(to - from, -most, most);
  };
  ManoeuvrePoint p;
  double since = 0;  // the value is reached
  while (since < window && p.t < c.lookahead) {
    bool reached = true;
    if (kind == ManoeuvreKind::kTrack) {
      course = towards(course, value, c.track.turn_rate * kStep);
      reached = course == value;
    } else if (kind == ManoeuvreKind::kSpeed) {
      speed = towards(speed, value, c.speed.accel * kStep);
      reached = speed == value;
    } else {
      vz = towards(vz, value, c.vertical_speed.accel * kStep);
      reached = vz == value;
    }
    p = {p.t + kStep,
         p.x + kStep * speed * math::cos(course),
         p.y + kStep * speed * math::sin(course),
         p.z + kStep * vz,
         speed * math::cos(course),
         speed * math::sin(course),
         vz};
    if (reached) since += kStep;
    if (is_within(volume, relative_motion(o, p, i))) return true;
  }
  return false;
}

TEST(WellClearLaw, ValuesWithoutConflictKeepClearWhenFlown) {
  EXPECT_TRUE(rc::check([] {
    RandomEncounter random(*rc::gen::inRange(0, 1 << 30));
    const WellClearConfiguration& c = configuration_of(1);
    const AircraftMotion own = random.aircraft(1000, 100);
    const std::vector<Intruder> intruders = random.intruders(1, c);
    BandMaker maker(c);
    // Between two values of steps anything may happen, and within a step of a manoeuvre:
    // the ends of pieces are looked at, with volumes that are smaller by a metre.
    const auto kind = static_cast<ManoeuvreKind>(*rc::gen::inRange(0, 3));
    WellClearConfiguration smaller = c;
    for (AlertLevel& level : smaller.alerters[0].levels) {
      level.volume.horizontal -= 3;
      level.volume.vertical -= 1;
    }
    const ManoeuvreBands& bands = maker.bands(kind, own, intruders);
    for (const BandPiece& piece : bands.pieces) {
      if (piece.region != AlertRegion::kNone) continue;
      const bool track = kind == ManoeuvreKind::kTrack;
      const double off = track ? geo::wrap_pi(piece.lo - bands.own) : 0;
      // North is no value of a step; half a turn goes to one side or the other.
      if (track && (piece.lo == 0 || std::abs(off) > geo::radians(179.5))) continue;
      const double value = track ? bands.own + off : piece.lo;
      RC_ASSERT(!meets(smaller, own, intruders[0], kind, value,
                       c.alerters[0].levels[1].alerting_time - 0.01));
    }
  }));
}

TEST(WellClearLaw, WhatIsAdvisedIsFreeOrRegainsWellClear) {
  EXPECT_TRUE(rc::check([] {
    RandomEncounter random(*rc::gen::inRange(0, 1 << 30));
    const WellClearConfiguration& c = configuration_of(*rc::gen::inRange(0, 2));
    BandAdvisor advisor(c);
    const AircraftMotion own = random.aircraft(1000, 100);
    std::vector<TrackedIntruder> tracks;
    for (const Intruder& each : random.intruders(3, c))
      tracks.push_back(
          {static_cast<std::uint32_t>(tracks.size()), each.motion, 10, 5, each.alerter});
    const FlightGoal goal{7 * random.uniform() - 3, 20, 0};
    const BandAdvisor::Advice& advice = advisor.advise(0, own, tracks, goal);
    RC_ASSERT(advice.alerts.size() == tracks.size());
    const ManoeuvreBands& bands = advisor.bands(ManoeuvreKind::kTrack);
    bool any = false;
    for (const BandPiece& piece : bands.pieces)
      any = any || !is_corrective(piece.region, c.corrective);
    RC_ASSERT(any == advice.track.has_value());
    if (!any) return;
    RC_ASSERT(!is_corrective(advice.track->region, c.corrective));
    // Nothing between it and the goal is free.
    const double off = geo::wrap_pi(advice.track->value - goal.track);
    for (double part = 0.05; part < 0.99; part += 0.1)
      if (std::abs(off) > geo::radians(1))
        RC_ASSERT(is_corrective(bands.region(goal.track + part * off), c.corrective));
  }));
}

}  // namespace
}  // namespace skein::model::test::well_clear_property_test
