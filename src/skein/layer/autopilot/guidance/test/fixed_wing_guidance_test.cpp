// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/autopilot/guidance/fixed_wing_guidance.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <functional>

#include "skein/layer/autopilot/guidance/test/point_wing.h"
#include "skein/model/path/path_geometry.h"
#include "skein/model/path/wind_triangle.h"

namespace skein::autopilot::fixed_wing_guidance_test {
namespace {

struct Flight {
  explicit Flight(const Vec2& wind = Vec2::Zero(),
                  const FixedWingGuidanceOptions& options = {})
      : guidance(options, FlightLimits{15, 40, 3, 11, 20, 3}, {0, 0, -100}) {
    wing.wind = wind;
  }
  void fly(double seconds, const std::function<void()>& watch = {}) {
    const int steps = static_cast<int>(std::lround(seconds / PointWing::kStep));
    for (int i = 0; i < steps; ++i) {
      demand = guidance.step(motion_of(wing.nav()), PointWing::kStep);
      wing.step(demand);
      if (watch) watch();
    }
  }
  std::optional<std::string> command(const AutopilotCommand& command) {
    return guidance.command(command, motion_of(wing.nav()));
  }
  Vec2 position() const { return wing.p.head<2>(); }

  PointWing wing;
  FixedWingGuidance guidance;
  FixedWingDemand demand;
};

Path join(std::initializer_list<std::pair<double, double>> length_and_curvature) {
  Path path;
  model::Pose at{{0, 0}, 0};
  for (const auto& [length, curvature] : length_and_curvature) {
    path.push_back({at.position, at.course, length, curvature});
    at = model::end_of(path.back());
  }
  return path;
}

struct Errors {
  double sum2 = 0, max = 0;
  int n = 0;
  void add(double e) {
    sum2 += e * e;
    ++n;
    max = std::max(max, std::abs(e));
  }
  double rms() const { return n > 0 ? std::sqrt(sum2 / n) : 0; }
};

struct Accuracy {
  Errors straight, turn;
};

FixedWingGuidanceOptions with_law(LateralLaw law) {
  FixedWingGuidanceOptions options;
  options.lateral.law = law;
  return options;
}

// Straights and turns of the radius that the wind allows, in wind from eight directions.
Accuracy fly_turns(LateralLaw law, double wind_speed) {
  const double r = 1.1 * model::ground_turn_radius(40, 15, wind_speed);
  const double quarter = geo::kPi / 2 * r, k = 1 / r;
  const Path path = join({{400, 0},
                          {2 * quarter, k},
                          {300, 0},
                          {2 * quarter, -k},
                          {300, 0},
                          {quarter, k},
                          {200, 0},
                          {3 * quarter, -k},
                          {200, 0}});
  Accuracy accuracy;
  for (int i = 0; i < 8; ++i) {
    Flight flight(wind_speed * geo::unit(i * geo::kPi / 4), with_law(law));
    flight.wing.heading = model::heading_for_course(0, 15, flight.wing.wind).value();
    EXPECT_FALSE(flight.command({FollowPath{path}, 100}));
    double along = 0;
    for (int n = 0; n < 60000 && !flight.guidance.status().done; ++n) {
      flight.fly(PointWing::kStep);
      const auto at = model::project(path, flight.position(), along - 50, along + 100);
      along = at.along;
      if (along < 200) continue;
      // A straight counts from 100 m after a turn.
      bool after = false;
      for (double back = 0; back <= 100; back += 10)
        after |= model::curvature_at(path, along - back) != 0;
      (after ? accuracy.turn : accuracy.straight).add(at.cross_track);
    }
    EXPECT_TRUE(flight.guidance.status().done);
  }
  return accuracy;
}

const char* name(LateralLaw law) {
  return law == LateralLaw::kCourse ? "course" : law == LateralLaw::kL1 ? "L1" : "L+2";
}

TEST(FixedWingGuidance, FollowsStraightsAndTurnsWithEachLaw) {
  for (const LateralLaw law : {LateralLaw::kCourse, LateralLaw::kL1, LateralLaw::kL2Plus})
    for (const double wind : {0.0, 5.0, 8.0}) {
      const Accuracy a = fly_turns(law, wind);
      std::printf("%-6s %.0f m/s: straight rms %.2f max %.2f, turn rms %.2f max %.2f m\n",
                  name(law), wind, a.straight.rms(), a.straight.max, a.turn.rms(),
                  a.turn.max);
      EXPECT_LT(a.straight.rms(), 1);
      EXPECT_LT(a.turn.rms(), 3);
    }
}

TEST(FixedWingGuidance, CirclesWithEachLaw) {
  for (const LateralLaw law : {LateralLaw::kCourse, LateralLaw::kL1, LateralLaw::kL2Plus})
    for (const double wind : {0.0, 5.0, 8.0})
      for (const bool clockwise : {true, false}) {
        Flight flight({0, wind}, with_law(law));
        EXPECT_FALSE(flight.command({Circle{{300, 100}, 120, clockwise}, 100}));
        flight.fly(120);
        Errors errors;
        flight.fly(
            60, [&] { errors.add((flight.position() - Vec2(300, 100)).norm() - 120); });
        std::printf("%-6s circle %.0f m/s: rms %.2f max %.2f m\n", name(law), wind,
                    errors.rms(), errors.max);
        EXPECT_LT(errors.max, 1.5);
      }
}

// A plan along a path at a constant ground speed that climbs evenly.
Plan plan_along(const Path& path, double speed, double start, double low, double climb) {
  Plan plan;
  const double total = model::length(path);
  const int n = static_cast<int>(total / 30);
  for (int i = 0; i <= n; ++i) {
    const double s = total * i / n;
    const model::Pose at = model::pose_at(path, s);
    const Vec2 v = speed * geo::unit(at.course);
    plan.push_back({Time::from_seconds(start + s / speed),
                    {at.position.x(), at.position.y(), -(low + climb * s / speed)},
                    {v.x(), v.y(), -climb}});
  }
  return plan;
}

TEST(FixedWingGuidance, ArrivesWhenThePlanSays) {
  const double r = 1.1 * model::ground_turn_radius(40, 15, 5);
  const Path path = join({{400, 0}, {geo::kPi * r, 1 / r}, {500, 0}});
  for (const double wind : {0.0, 2.5})
    for (int i = 0; i < 4; ++i) {
      Flight flight(wind * geo::unit(0.3 + i * geo::kPi / 2));
      // Five seconds too late at the start.
      const Plan plan = plan_along(path, 14, -5, 100, 0.5);
      ASSERT_FALSE(flight.command({FollowPlan{plan}, 0}))
          << *flight.command({FollowPlan{plan}, 0});
      flight.fly(30);
      Errors track, time, altitude;
      const double left = plan.back().time.seconds() - flight.wing.time.seconds() - 1;
      flight.fly(left, [&] {
        const AutopilotStatus& status = flight.guidance.status();
        track.add(status.cross_track);
        time.add(status.time_error);
        const double planned =
            100 + 0.5 * (flight.wing.time.seconds() - status.time_error + 5);
        altitude.add(-flight.wing.p.z() - planned);
      });
      std::printf(
          "plan, %.1f m/s: track rms %.2f, time rms %.2f max %.2f s, alt %.2f m\n", wind,
          track.rms(), time.rms(), time.max, altitude.max);
      EXPECT_LT(track.rms(), 1);
      // 5 s late, taken out at 0.1/s from 5 s to 30 s on, and the turn's changes.
      EXPECT_LT(time.max, 1);
      EXPECT_LT(altitude.max, 1);
      flight.fly(4);
      EXPECT_TRUE(flight.guidance.status().done);
      EXPECT_FALSE(flight.guidance.status().follows);
    }
}

TEST(FixedWingGuidance, FliesThePlansEndOnInACircleAtItsAltitude) {
  Flight flight;
  const Plan plan = plan_along(join({{300, 0}}), 15, 0, 100, 1);
  ASSERT_FALSE(flight.command({FollowPlan{plan}, 0}));
  flight.fly(90);
  EXPECT_TRUE(flight.guidance.status().done);
  EXPECT_NEAR(-flight.wing.p.z(), 120, 0.5);
  flight.fly(60, [&] {
    EXPECT_NEAR((flight.position() - Vec2(300, 0)).norm(), 44, 2);  // 1.1 turn_radius
  });
}

std::vector<FlyWaypoints::Waypoint> square() {
  return {{{300, 0}, 100}, {{300, 300}, 115}, {{0, 300}, 130}, {{0, 0}, 100}};
}

TEST(FixedWingGuidance, FliesLapsOfWaypoints) {
  for (const bool rounds : {true, false})
    for (const double wind : {0.0, 5.0}) {
      FixedWingGuidanceOptions options;
      options.rounds_corners = rounds;
      Flight flight({wind, 0}, options);
      ASSERT_FALSE(flight.command({FlyWaypoints{square(), 3}, 100}));
      std::vector<double> nearest(4, 1e9);
      Errors track, altitude;
      double last = 1e9, worst_jump = 0;
      int steps = 0;
      for (; steps < 60000 && !flight.guidance.status().done; ++steps) {
        flight.fly(PointWing::kStep);
        const AutopilotStatus& status = flight.guidance.status();
        for (std::size_t k = 0; k < 4; ++k)
          nearest[k] =
              std::min(nearest[k], (flight.position() - square()[k].point).norm());
        if (status.done) break;
        // Where a corner is cut by its arc the distance left falls faster: by 2 (tan -
        // angle) radii at most, 0.43 R at a right angle.
        if (last < 1e8)
          worst_jump = std::max(worst_jump, std::abs(last - status.remaining));
        last = status.remaining;
        if (steps * PointWing::kStep > 25) track.add(status.cross_track);
        altitude.add(-flight.wing.p.z() - flight.demand.altitude_msl);
      }
      std::printf(
          "waypoints %s, %.0f m/s: %.0f s, track rms %.2f max %.2f, alt %.2f, "
          "corners %.1f m\n",
          rounds ? "rounded" : "flown over", wind, steps * PointWing::kStep, track.rms(),
          track.max, altitude.max, nearest[1]);
      EXPECT_TRUE(flight.guidance.status().done);
      // Four legs of 300 m three times, less what the arcs cut, at 10 to 20 m/s.
      EXPECT_GT(steps * PointWing::kStep, 160);
      EXPECT_LT(steps * PointWing::kStep, 320);
      EXPECT_LT(worst_jump, 50);
      if (rounds) {
        EXPECT_LT(track.max, 1.5);
        EXPECT_LT(altitude.max, 2.5);
      } else {
        for (const double d : nearest) EXPECT_LT(d, 5);
      }
    }
}

TEST(FixedWingGuidance, HoldsAPositionInWind) {
  for (const double wind : {0.0, 8.0}) {
    Flight flight({0, wind});
    ASSERT_FALSE(flight.command({HoldPosition{{500, 200}}, 120}));
    flight.fly(120);
    EXPECT_TRUE(flight.guidance.status().done);
    EXPECT_NEAR(-flight.wing.p.z(), 120, 0.5);
    const double radius = flight.guidance.loiter_radius(wind);
    flight.fly(60, [&] {
      EXPECT_NEAR((flight.position() - Vec2(500, 200)).norm(), radius, 1.5);
    });
  }
}

TEST(FixedWingGuidance, WidensItsCircleWhenTheWindGrows) {
  Flight flight;
  ASSERT_FALSE(flight.command({Circle{{0, 0}, 60, true}, 100}));
  flight.fly(60);
  flight.wing.wind = {9, 0};
  flight.fly(60);
  // (V + w)^2 / a with the slowest airspeed in a turn: 11 (1 + (a/g)^2)^(1/4), a =
  // 15^2/40.
  const double slowest = 11 * std::pow(1 + std::pow(5.625 / kGravity, 2), 0.25);
  const double radius = (slowest + 9) * (slowest + 9) / 5.625;
  flight.fly(60, [&] { EXPECT_NEAR(flight.position().norm(), radius, 4); });
}

TEST(FixedWingGuidance, ReturnsHomeAtASafeAltitude) {
  Flight flight({3, 3});
  flight.wing.p = {900, -700, -110};
  ASSERT_FALSE(flight.command({Return{}, 50}));
  flight.fly(5);
  EXPECT_FALSE(flight.guidance.status().done);
  flight.fly(150);
  EXPECT_TRUE(flight.guidance.status().done);
  EXPECT_LT(flight.position().norm(), 130);
  EXPECT_NEAR(-flight.wing.p.z(), 160, 0.5);  // return_height above home at 100 m
}

TEST(FixedWingGuidance, FliesStraightToCirclesFarAway) {
  for (const LateralLaw law :
       {LateralLaw::kCourse, LateralLaw::kL1, LateralLaw::kL2Plus}) {
    FixedWingGuidanceOptions options;
    options.lateral.law = law;
    Flight flight(Vec2::Zero(), options);
    flight.wing.p = {-1830, 0, -100};  // the nose to the north, towards the centre
    ASSERT_FALSE(flight.command({HoldPosition{Vec2::Zero()}, 100}));
    // The tangent to the circle.
    const double radius = flight.guidance.loiter_radius(0);
    const double straight = std::sqrt(1830 * 1830 - radius * radius);
    flight.fly(PointWing::kStep);
    double travelled = 0;
    for (int i = 0; i < 20000 && flight.guidance.status().remaining >= 1; ++i) {
      flight.fly(PointWing::kStep);
      travelled += flight.wing.airspeed * PointWing::kStep;
    }
    EXPECT_LT(travelled, 1.03 * straight);
    EXPECT_GT(travelled, 0.97 * straight);
  }
}

TEST(FixedWingGuidance, FliesOnWhenAGustHasLiftedItInItsRun) {
  Flight flight(Vec2::Zero());
  flight.wing.p.setZero();
  flight.wing.airspeed = 0;
  flight.wing.on_ground = true;
  ASSERT_FALSE(flight.command({TakeOff{0}, 120}));
  flight.fly(1);
  ASSERT_EQ(flight.demand.phase, FlightPhase::kRun);
  FixedWingMotion now = motion_of(flight.wing.nav());
  now.v_N.z() = -0.3;  // over a bump
  EXPECT_EQ(flight.guidance.step(now, PointWing::kStep).phase, FlightPhase::kRun);
  now.v_N.z() = -0.7;
  EXPECT_EQ(flight.guidance.step(now, PointWing::kStep).phase, FlightPhase::kClimbOut);
}

TEST(FixedWingGuidance, TakesOffAndLandsAgain) {
  for (const double wind : {0.0, 5.0}) {
    Flight flight({-wind, 0});
    FixedWingGuidanceOptions options;
    options.landing.roll_friction = flight.wing.friction / kGravity;
    options.landing.brake_friction =
        (flight.wing.brakes - flight.wing.friction) / kGravity;
    flight.guidance = FixedWingGuidance(options, flight.wing.limits, {0, 0, 0});
    flight.wing.p.setZero();
    flight.wing.airspeed = 0;
    flight.wing.on_ground = true;
    ASSERT_FALSE(flight.command({TakeOff{0}, 120}));
    flight.fly(1);
    EXPECT_EQ(flight.demand.phase, FlightPhase::kRun);
    flight.fly(15);
    EXPECT_EQ(flight.demand.phase, FlightPhase::kClimbOut);
    EXPECT_EQ(flight.demand.airspeed, 1.3 * flight.wing.limits.slowest);
    EXPECT_LT(std::abs(flight.position().y()), 1);
    flight.fly(60);
    EXPECT_TRUE(flight.guidance.status().done);
    EXPECT_NEAR(-flight.wing.p.z(), 120, 5);

    ASSERT_FALSE(flight.command({Land{{200, 50}, 0, std::nullopt}, 120}));
    double touch_sink = 0;
    Vec2 touch = Vec2::Zero();
    bool approached = false, was_up = true;
    Errors line;
    for (int i = 0; i < 40000 && !flight.guidance.status().done; ++i) {
      const double climb = flight.wing.climb;
      flight.fly(PointWing::kStep);
      if (flight.demand.phase == FlightPhase::kApproach) {
        approached = true;
        line.add(flight.guidance.status().cross_track);
      }
      if (flight.wing.on_ground && was_up) touch_sink = climb, touch = flight.position();
      was_up = !flight.wing.on_ground;
    }
    std::printf("landing, %.0f m/s: touch %.1f %.1f m at %.2f m/s, line %.2f m\n", wind,
                touch.x(), touch.y(), touch_sink, line.max);
    EXPECT_TRUE(approached);
    EXPECT_EQ(flight.demand.phase, FlightPhase::kGround);
    EXPECT_LT(line.max, 2);
    // It brakes so that it stops there, or before by what friction alone leaves.
    EXPECT_LT((flight.position() - Vec2(200, 50)).norm(), 5);
    EXPECT_GT(touch_sink, -0.8);
    // Against the wind.
    if (wind > 0) {
      EXPECT_NEAR(geo::wrap_pi(flight.wing.heading), 0, 0.1);
    }
  }
}

TEST(WaypointRoute, RoundsTheCornerAheadAsTheWindThatIsKnownNowAsks) {
  // The wind is not known yet when a route begins.
  FlyWaypoints command;
  command.points = {{{400, 0}, 100}, {{400, 400}, 100}};
  WaypointRoute route;
  route.begin(command, {0, 0, -100}, {40, 0});
  const auto tightest = [&] { return route.cursor().tightest(0, 600); };
  route.project({100, 0}, 50);
  route.set_rule({42, 0});
  EXPECT_DOUBLE_EQ(tightest(), 1 / 40.0) << "hardly another";
  route.set_rule({90, 0});
  EXPECT_DOUBLE_EQ(tightest(), 1 / 90.0);
  const WaypointRoute::Place place = route.project({110, 3}, 50);
  EXPECT_NEAR(place.on_path.along, 110, 1e-9) << "it goes on where it was";
  EXPECT_NEAR(place.on_path.cross_track, 3, 1e-9);
  route.project({295, 0}, 200);  // the arc begins at 310
  route.set_rule({60, 0});
  EXPECT_DOUBLE_EQ(tightest(), 1 / 90.0) << "too near";
}

TEST(RollOut, IsTheDistanceThatFrictionAndDragLeave) {
  // Where the wings carry it at the touch, without wind, in closed form.
  const double closed = 20 * 20 / (2 * kGravity) * std::log(0.08 / 0.2) / (0.08 - 0.2);
  EXPECT_NEAR(roll_out(20, 0, {0.2, 0.08, 20}), closed, 0.01);
  // In wind, with lift that goes early or late, against small steps in time.
  for (const double wind : {0.0, 4.0, -3.0})
    for (const double lift_off : {15.0, 26.0}) {
      constexpr double kDt = 1e-3;
      double speed = 20 - wind, travelled = 0;
      while (speed > 0) {
        const double air = speed + wind;
        const double pressed = std::max(1 - air * air / (lift_off * lift_off), 0.0);
        travelled += speed * kDt;
        speed -= kGravity * (0.2 * pressed + 0.08 * air * air / 400) * kDt;
      }
      EXPECT_NEAR(roll_out(20, wind, {0.2, 0.08, lift_off}), travelled,
                  0.002 * travelled + 0.02);
    }
}

TEST(Landing, FeelsTheGroundAndGoesOnFlyingWhenItIsThrownUp) {
  const FlightLimits limits{15, 40, 3, 11, 20, 3};
  for (const bool measured : {true, false}) {
    Landing landing;
    landing.begin({{0, 0}, 0, 0.0}, {{-900, 0}, 0}, Vec2::Zero(), 50, limits, {});
    Landing::View now;
    now.ground_speed = 12;
    const auto at = [&](double x, double height, double climb, double seconds) {
      Landing::Step step;
      for (double t = 0; t < seconds; t += 0.01) {
        now.p = {x, 0};
        now.altitude_msl = height;
        if (measured) now.height_agl = height;
        now.climb_rate = climb;
        step = landing.step(now, 0.01);
      }
      return step;
    };
    for (double x = -900; x < -60; x += 10) at(x, 40, 0, 0.01);
    EXPECT_EQ(at(-60, 3, -1, 0.1).phase, FlightPhase::kFlare);
    EXPECT_GT(at(-59, 3, -1, 0.1).airspeed, 0);
    EXPECT_EQ(at(-40, 0.9, -0.5, 0.1).airspeed, 0) << "motor idle";
    EXPECT_EQ(at(-38, 0.1, -0.5, 0.5).phase, FlightPhase::kFlare) << "it still sinks";
    EXPECT_EQ(at(-36, 0.1, 0, 0.2).phase, FlightPhase::kFlare) << "not long enough";
    const Landing::Step rolling = at(-30, 0.1, 0, measured ? 0.2 : 1.2);
    EXPECT_EQ(rolling.phase, FlightPhase::kRollOut);
    EXPECT_NEAR(rolling.braking, 12 * 12 / (2 * 30.0), 1e-9);
    if (measured) {
      EXPECT_EQ(at(-25, 0.9, 0.5, 0.1).phase, FlightPhase::kFlare) << "a gust";
      EXPECT_EQ(at(-15, 0.1, 0, 0.5).phase, FlightPhase::kRollOut);
    }
    now.still = true;
    now.ground_speed = 0.1;
    EXPECT_EQ(at(-1, 0.1, 0, 1.2).phase, FlightPhase::kGround);
  }
}

TEST(FixedWingGuidance, CirclesDownBeforeAnApproachFromTooHigh) {
  Flight flight;
  flight.wing.p = {-450, 0, -250};
  ASSERT_FALSE(flight.command({Land{{0, 0}, 0, 0.0}, 250}));
  for (int i = 0; i < 60000 && !flight.guidance.status().done; ++i) {
    flight.fly(PointWing::kStep);
    if (flight.demand.phase == FlightPhase::kApproach) {
      EXPECT_LT(-flight.wing.p.z(), 40 + 12 + 0.1);
    }
  }
  EXPECT_EQ(flight.demand.phase, FlightPhase::kGround);
  EXPECT_LT(flight.position().norm(), 120);
}

TEST(FixedWingGuidance, RefusesWhatItCannotFlyAndGoesOn) {
  Flight flight;
  ASSERT_FALSE(flight.command({HoldCourse{1}, 100}));
  const auto reason = flight.command({Circle{{0, 0}, 5, true}, 100});
  ASSERT_TRUE(reason);
  EXPECT_NE(reason->find("radius of 5 m"), std::string::npos) << *reason;
  flight.fly(30);
  EXPECT_NEAR(flight.wing.heading, 1, 1e-3);
}

TEST(FixedWingGuidance, ARepeatedPathGoesOn) {
  Flight once, often;
  const Path path = join({{400, 0}, {100, 0.01}, {100, 0}});
  ASSERT_FALSE(once.command({FollowPath{path}, 110}));
  for (int i = 0; i < 30; ++i) {
    ASSERT_FALSE(often.command({FollowPath{path}, 110}));
    once.fly(1);
    often.fly(1);
  }
  EXPECT_EQ(once.wing.p, often.wing.p);
}

TEST(FixedWingGuidance, SlowsDownForTightTurns) {
  const Path path = join({{300, 0}, {geo::kPi * 45, 1 / 45.0}, {300, 0}});
  for (int i = 0; i < 4; ++i) {
    Flight flight(3 * geo::unit(i * geo::kPi / 2));
    flight.wing.heading = model::heading_for_course(0, 15, flight.wing.wind).value();
    ASSERT_FALSE(flight.command({FollowPath{path}, 100}));
    Errors track;
    double slowest = 1e9;
    flight.fly(45, [&] {
      if (flight.guidance.status().follows)
        track.add(flight.guidance.status().cross_track);
      slowest = std::min(slowest, flight.demand.airspeed);
    });
    EXPECT_LT(slowest, 14);
    EXPECT_LT(track.max, 2);
  }
}

TEST(FixedWingGuidance, ThePathToACircleCountsAsNoErrorOfIt) {
  FixedWingGuidance guidance({}, FlightLimits{}, Vec3::Zero());
  FixedWingMotion motion;
  motion.v_N = {20, 0, 0};
  motion.airspeed = 20;
  guidance.command({Circle{{0, 0}, 100, true}, 300}, motion);
  guidance.step(motion, 0.1);
  EXPECT_FALSE(guidance.status().follows) << "it starts at the centre";
  motion.p_N = {0, -90, -300};
  guidance.step(motion, 0.1);
  EXPECT_TRUE(guidance.status().follows);
  EXPECT_NEAR(guidance.status().cross_track, 10, 1e-9);
  motion.p_N = {0, -200, -300};
  guidance.step(motion, 0.1);
  EXPECT_TRUE(guidance.status().follows) << "blown off it is an error";
}

}  // namespace
}  // namespace skein::autopilot::fixed_wing_guidance_test
