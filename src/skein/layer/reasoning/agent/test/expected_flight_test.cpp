// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/agent/expected_flight.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "skein/base/math.h"
#include "skein/layer/reasoning/trajectory/steering_flight.h"
#include "skein/model/path/flight_plan.h"

namespace skein::reasoning::expected_flight_test {
namespace {

class Hill final : public Terrain {
 public:
  double elevation_msl(const Vec2& p) const override {
    return 150 * math::exp(-(p - Vec2(2000, 0)).squaredNorm() / (2 * 600.0 * 600.0));
  }
  Vec2 gradient(const Vec2& p) const override {
    return -elevation_msl(p) * (p - Vec2(2000, 0)) / (600.0 * 600.0);
  }
};

struct Aircraft {
  Hill ground;
  FlightContext context{EntityId{1}, {}, &ground, {}, 120};
  NavEstimate nav;

  Aircraft() { nav.p_N = Vec3(0, 0, -120); }
  FlightPlan expect(decltype(FlightIntent::what) what, std::size_t passed = 0) const {
    return expected_flight({1, std::move(what)}, passed, nav, context, 10, 150).plan;
  }
};

void expect_joined(const FlightPlan& plan) {
  ASSERT_FALSE(plan.empty());
  EXPECT_EQ(model::start_of(plan), 10);
  for (std::size_t k = 1; k < plan.size(); ++k) {
    const model::FlightMoment end = model::end_of(plan[k - 1]);
    EXPECT_NEAR(plan[k].start, plan[k - 1].start + plan[k - 1].duration, 1e-6);
    EXPECT_LT((geo::horizontal(end.p_N) - geo::horizontal(plan[k].p_N)).norm(), 1e-3);
    EXPECT_LT(std::abs(end.p_N.z() - plan[k].p_N.z()), 4) << "at " << plan[k].start;
  }
}

TEST(ExpectedFlight, SteeringTurnsToItsCourseAndGoesOn) {
  Aircraft aircraft;
  aircraft.nav.wind_N = Vec2(0, 6);
  const FlightPlan plan = aircraft.expect(Steering{HoldCourse{2}, 2, 200.0, {}});
  expect_joined(plan);
  const model::FlightMoment end = model::end_of(plan.back());
  EXPECT_NEAR(geo::wrap_pi(geo::bearing(geo::horizontal(end.v_N)) - 2), 0, 0.02);
  EXPECT_NEAR(-end.p_N.z(), 200, 0.1);
  EXPECT_NEAR(model::end_time_of(plan), 160, 0.1);
}

// From outside and from the centre, in wind from all sides: on the circle that guidance
// flies, clockwise, and not drifting away with the wind.
TEST(ExpectedFlight, CirclesAreFlownOverGround) {
  for (const Vec2& centre : {Vec2(600, 300), Vec2(0, 0), Vec2(-40, 60)})
    for (double from = 0; from < 6; from += 1) {
      Aircraft aircraft;
      aircraft.nav.wind_N = 6 * geo::unit(from);
      const FlightPlan plan = aircraft.expect(Circling{centre, 150.0});
      expect_joined(plan);
      const double radius = wide_radius(aircraft.context.limits, aircraft.nav.wind_N);
      ASSERT_GT(model::end_time_of(plan), 124);
      EXPECT_LT(plan.size(), 50U);
      for (double time = 75; time < 124; time += 1) {
        const model::FlightMoment m = model::moment_at(plan, time);
        const Vec2 out = geo::horizontal(m.p_N) - centre;
        EXPECT_NEAR(out.norm(), radius, 0.15 * radius) << time << " wind to " << from;
        EXPECT_GT(geo::cross(out, geo::horizontal(m.v_N)), 0);
      }
    }
}

TEST(ExpectedFlight, LegsGoOnBehindThePointsThatWerePassed) {
  const Aircraft aircraft;
  const std::vector<Vec2> points = {{500, 0}, {500, 800}, {-500, 800}};
  const auto nearest = [&](const FlightPlan& plan, const Vec2& point) {
    double least = 1e9;
    for (double time = 10; time < model::end_time_of(plan); time += 0.5)
      least = std::min(
          least, (geo::horizontal(model::moment_at(plan, time).p_N) - point).norm());
    return least;
  };
  Legs legs;
  legs.points = points;
  legs.altitude_msl = 120;
  const FlightPlan all = aircraft.expect(legs), rest = aircraft.expect(legs, 1);
  expect_joined(all);
  for (const Vec2& point : points) EXPECT_LT(nearest(all, point), 10);
  EXPECT_GT(nearest(rest, points[0]), 100);
  EXPECT_LT(nearest(rest, points[1]), 10);
}

// Straight over a hill of 150 m: within a few metres of what is flown.
TEST(ExpectedFlight, KeepsItsHeightOverTheGround) {
  const Aircraft aircraft;
  const FlightPlan plan = aircraft.expect(Steering{HoldCourse{0}, 0, {}, {}});
  expect_joined(plan);
  double highest = 0;
  for (double time = 10; time < 160; time += 1) {
    const Vec3 p_N = model::moment_at(plan, time).p_N;
    EXPECT_GT(-p_N.z() - aircraft.ground.elevation_msl(geo::horizontal(p_N)), 110)
        << time;
    highest = std::max(highest, -p_N.z());
  }
  EXPECT_NEAR(highest, 270, 15);
  EXPECT_LT(plan.size(), 20u) << "few pieces, as all of it is sent";
}

}  // namespace
}  // namespace skein::reasoning::expected_flight_test
