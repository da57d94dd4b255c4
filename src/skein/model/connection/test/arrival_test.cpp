// SPDX-License-Identifier: Apache-2.0
#include "skein/model/connection/arrival.h"

#include <gtest/gtest.h>

#include <cmath>

#include "skein/model/connection/airplane.h"
#include "skein/model/connection/test/dense_search.h"
#include "skein/model/path/flight_plan.h"

namespace skein::model::arrival_test {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

// Joins in time, place and heading, turns no tighter than allowed and begins at `from`.
void expect_flyable(const FlightPlan& plan, const Pose& from, const AirMotion& air) {
  FlightMoment at;
  at.p_N.head<2>() = from.position;
  at.heading = from.course;
  double time = 0;
  for (const FlightElement& e : plan) {
    EXPECT_NEAR(e.start, time, 1e-9);
    EXPECT_LT(geo::horizontal(e.p_N - at.p_N).norm(), 1e-9);
    EXPECT_NEAR(geo::wrap_pi(e.heading - at.heading), 0, 1e-12);
    EXPECT_EQ(e.airspeed, air.airspeed);
    EXPECT_LE(std::abs(e.turn_rate), air.airspeed / air.turn_radius * (1 + 1e-12));
    time += e.duration;
    at = end_of(e);
  }
}

TEST(Arrival, IsThereAtThatTime) {
  int found = 0, gaps = 0;
  for (std::uint32_t i = 0; i < 1000; ++i) {
    const ConnectionQuery q = test::random_case(i);
    const double earliest = connect(q.from, q.to, q.air).time;
    const double circle = 2 * geo::kPi * q.air.turn_radius / q.air.airspeed;
    for (const double extra : {0.0, 0.01, 0.3, 0.9, 1.5, 7.2}) {
      const double time = earliest + extra * circle;
      const Arrival arrival = connect_at(q.from, q.to, q.air, time);
      gaps += arrival.status == ArrivalStatus::kGap;
      if (arrival.status != ArrivalStatus::kFound) continue;
      ++found;
      expect_flyable(arrival.plan, q.from, q.air);
      ASSERT_NEAR(duration(arrival.plan), time, 1e-9 * time + 1e-9);
      const FlightMoment end = end_of(arrival.plan.back());
      // The length is met to 1e-10 radii; the wind carries on for that long.
      ASSERT_LT((geo::horizontal(end.p_N) - q.to.position).norm(),
                1e-8 * q.air.turn_radius)
          << i << " " << extra;
      ASSERT_NEAR(geo::wrap_pi(end.heading - q.to.course), 0, 1e-8);
    }
  }
  // Lengths that cannot be flown are known for near goals only.
  EXPECT_GT(found, 5700);
  EXPECT_GT(gaps, 0);
}

TEST(Arrival, SaysWhenItIsTooEarly) {
  const AirMotion air{15, 60, {3, -4}};
  const Pose from{{0, 0}, 0}, to{{900, 300}, 1};
  const double earliest = connect(from, to, air).time;
  const Arrival early = connect_at(from, to, air, 0.99 * earliest);
  EXPECT_EQ(early.status, ArrivalStatus::kTooEarly);
  EXPECT_EQ(early.earliest, earliest);
  EXPECT_TRUE(early.plan.empty());
  EXPECT_EQ(connect_at(from, to, {15, 60, {15, 0}}, 100).status,
            ArrivalStatus::kNotConnected);
  EXPECT_EQ(connect_at(from, to, air, kNever).status, ArrivalStatus::kNotConnected);
  EXPECT_EQ(connect_at(from, to, air, 1e300).status, ArrivalStatus::kNotConnected);
}

TEST(Airplane, ClimbsOnThePathOnADetourOrInCircles) {
  const AirMotion air{15, 60, {3, -4}};
  const ClimbLimits limits{2, 3};
  const FlightState from{{0, 0, -100}, 0.3};
  const Pose start{{0, 0}, 0.3};
  const Vec2 place(900, 300);
  const double level = connect(start, {place, 1}, air).time;
  struct Expectation {
    double climb, time;
    AltitudeCase altitude;
  };
  const double circle = 2 * geo::kPi * 60 / 15;
  for (const Expectation& e :
       {Expectation{50, level, AltitudeCase::kLow},
        Expectation{-100, level, AltitudeCase::kLow},
        Expectation{2 * (level + 5), level + 5, AltitudeCase::kMedium},
        Expectation{-3 * (level + 5), level + 5, AltitudeCase::kMedium},
        Expectation{2 * (level + 3.4 * circle), level + 3.4 * circle,
                    AltitudeCase::kHigh}}) {
    const FlightState to{{place.x(), place.y(), -100 - e.climb}, 1};
    const SpaceConnection c = connect(from, to, air, limits);
    ASSERT_EQ(c.status, ConnectionStatus::kFound);
    EXPECT_EQ(c.altitude, e.altitude) << e.climb;
    EXPECT_NEAR(c.time, e.time, 1e-9) << e.climb;
    expect_flyable(c.plan, start, air);
    for (const FlightElement& element : c.plan) {
      EXPECT_LE(element.climb_rate, 2 + 1e-9);
      EXPECT_GE(element.climb_rate, -3 - 1e-9);
    }
    EXPECT_LT((end_of(c.plan.back()).p_N - to.p_N).norm(), 1e-6);
  }
}

TEST(Airplane, ReachesEverythingWhileTheWindIsWeaker) {
  for (std::uint32_t i = 0; i < 500; ++i) {
    const ConnectionQuery q = test::hard_case(i);
    const double climb = (i % 7 - 3.0) * 60;
    const FlightState from{{q.from.position.x(), q.from.position.y(), -500},
                           q.from.course};
    const FlightState to{{q.to.position.x(), q.to.position.y(), -500 - climb},
                         q.to.course};
    const double acceleration = i % 3 == 0 ? 0 : 1;
    const SpaceConnection c = connect(from, to, q.air, {2, 4, acceleration});
    ASSERT_EQ(c.status, ConnectionStatus::kFound) << i;
    EXPECT_GE(c.time, connect(q.from, q.to, q.air).time);
    if (c.plan.empty()) continue;
    expect_flyable(c.plan, q.from, q.air);
    EXPECT_LT((end_of(c.plan.back()).p_N - to.p_N).norm(), 1e-5) << i;
    double rate = 0;
    for (const FlightElement& e : c.plan) {
      EXPECT_LE(e.climb_rate, 2 + 1e-9);
      EXPECT_GE(e.climb_rate, -4 - 1e-9);
      if (acceleration == 0) continue;
      EXPECT_NEAR(e.climb_rate, rate, 1e-6) << i;
      EXPECT_LE(std::abs(e.climb_acceleration), 1 + 1e-9);
      rate = -end_of(e).v_N.z();
    }
    EXPECT_NEAR(rate, 0, 1e-6) << i;
  }
}

TEST(Airplane, ReachesFarPlacesWithTightTurns) {
  // A million turn radii away: rounding of the length is more than 1e-10 radii.
  const AirMotion air{20, 0.05, {3, -4}};
  for (const double climb : {0.0, 8000.0, 8100.0}) {
    const FlightState from{{0, 0, -100}, 2.45},
        to{{-40'000, 30'000, -100 - climb}, 0.387};
    const SpaceConnection c = connect(from, to, air, {3, 3});
    ASSERT_EQ(c.status, ConnectionStatus::kFound) << climb;
    EXPECT_LT((end_of(c.plan.back()).p_N - to.p_N).norm(), 1e-6);
  }
}

TEST(Airplane, RefusesWhatIsNoRate) {
  const FlightState a{{0, 0, -100}, 0}, b{{500, 0, -120}, 0};
  EXPECT_EQ(connect(a, b, AirMotion{}, {0, 3}).status, ConnectionStatus::kBadInput);
  EXPECT_EQ(connect(a, b, AirMotion{}, {3, -1}).status, ConnectionStatus::kBadInput);
  EXPECT_EQ(connect(a, b, AirMotion{}, {3, 3, -1}).status, ConnectionStatus::kBadInput);
  EXPECT_EQ(connect(a, {{500, 0, std::nan("")}, 0}, AirMotion{}, {}).status,
            ConnectionStatus::kBadInput);
  EXPECT_EQ(connect(a, {{500, 0, -1e300}, 0}, AirMotion{}, {}).status,
            ConnectionStatus::kBadInput);
  EXPECT_EQ(connect(a, b, {15, 60, {20, 0}}, {}).status,
            ConnectionStatus::kWindTooStrong);
}

}  // namespace
}  // namespace skein::model::arrival_test
