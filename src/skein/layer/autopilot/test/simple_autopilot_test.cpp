// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/autopilot/simple_autopilot.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <optional>

#include "skein/base/random.h"
#include "skein/model/path/path_geometry.h"
#include "skein/model/path/wind_triangle.h"

namespace skein::autopilot::simple_autopilot_test {
namespace {

constexpr double kStep = 0.02;  // [s]
constexpr double kAirspeed = 20, kRadius = 60;

// A vehicle of this test's own: first-order roll at 1 rad/s, coordinated turns, steady
// wind. (Layers do not know each other, so the plant of the asset layer is not used
// here.)
struct TestVehicle {
  Vec3 p = {0, 0, -300};
  double heading = 0, roll = 0, climb = 0, airspeed = kAirspeed;
  Vec2 wind = Vec2::Zero();

  Vec3 velocity() const {
    const Vec2 v = airspeed * geo::unit(heading) + wind;
    return {v.x(), v.y(), -climb};
  }
  void step(const FlightCommand& command) {
    const double limit = std::atan(kAirspeed * kAirspeed / (9.80665 * kRadius));
    const double setpoint = std::clamp(command.roll, -limit, limit);
    roll += std::clamp(setpoint - roll, -kStep, kStep);
    const double turn = 9.80665 * std::tan(roll) / airspeed * kStep;
    airspeed += (command.airspeed - airspeed) * kStep / 2;
    climb = std::clamp(command.climb_rate, -3.0, 3.0);
    heading += turn / 2;
    p += kStep * velocity();
    heading += turn / 2;
  }
};

class Flight {
 public:
  explicit Flight(const Vec2& wind, double course = 0) {
    vehicle.wind = wind;
    vehicle.heading = course;
    NavEstimate start;
    start.p_N = vehicle.p;
    start.v_N = {kAirspeed * std::cos(course), kAirspeed * std::sin(course), 0};
    start.heading = course;
    autopilot.emplace(SimpleAutopilotOptions{}, FlightLimits{}, start);
  }

  // Flies on; fixes at 5 Hz and air data at 20 Hz, `fix_error` added to positions.
  void fly(double seconds, const std::function<void()>& watch = {}) {
    const int steps = static_cast<int>(std::lround(seconds / kStep));
    for (int i = 0; i < steps; ++i, ++tick) {
      const Time now = Time::from_ns(tick * 20'000'000LL);
      if (tick % 10 == 0 && !gnss_off)
        autopilot->sense(
            GnssFix{now, vehicle.p + fix_error(), vehicle.velocity(), fix_sd});
      if (tick % 5 == 0)
        autopilot->sense(
            AirDataSample{now, vehicle.airspeed, geo::wrap_pi(vehicle.heading)});
      vehicle.step(std::get<FlightCommand>(autopilot->control(now, kStep)));
      if (watch) watch();
    }
  }
  Vec2 position() const { return geo::horizontal(vehicle.p); }
  Vec3 fix_error() {
    return fix_sd * Vec3(random.normal(), random.normal(), random.normal());
  }

  TestVehicle vehicle;
  std::optional<SimpleAutopilot> autopilot;
  std::int64_t tick = 0;
  double fix_sd = 0;
  bool gnss_off = false;
  RandomStream random{1, 0, Purpose::kTest};
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
  double straight = 0, turn = 0;  // largest cross-track [m]
};

Errors fly_path(const Path& path, const Vec2& wind) {
  Flight flight(wind);
  flight.fly(20);  // learns the wind while circling
  // Come from afar, so that the start's error is gone when the path begins.
  flight.vehicle.p = {-600, 0, -300};
  flight.vehicle.heading = std::atan2(-wind.y(), 20);
  flight.fly(0.5);
  Path lead{{{-600, 0}, 0, 600, 0}};
  lead.insert(lead.end(), path.begin(), path.end());
  flight.autopilot->command({FollowPath{lead}, 300});

  Errors worst;
  double along = 0;
  const double total = model::length(lead);
  for (int i = 0; i < 40000 && !flight.autopilot->status().done; ++i) {
    flight.fly(kStep);
    const auto at = model::project(lead, flight.position(), along - 50, along + 100);
    along = at.along;
    if (along < 400 || along >= total) continue;
    // A straight counts from 100 m after a turn: see docs/aircraft.md.
    bool after_turn = false;
    for (double back = 0; back <= 100; back += 10)
      after_turn |= model::curvature_at(lead, along - back) != 0;
    double& error = after_turn ? worst.turn : worst.straight;
    error = std::max(error, std::abs(at.cross_track));
  }
  EXPECT_TRUE(flight.autopilot->status().done);
  return worst;
}

// Largest errors over winds of 8 m/s from eight directions, on turns of this radius.
Errors worst_in_wind(double radius) {
  const double k = 1 / radius;
  const double quarter = geo::kPi / 2 * radius;
  const Path path = join({{500, 0},
                          {2 * quarter, k},
                          {400, 0},
                          {2 * quarter, -k},
                          {400, 0},
                          {quarter, k},
                          {300, 0},
                          {3 * quarter, -k},
                          {300, 0}});
  Errors worst;
  for (int i = 0; i < 8; ++i) {
    const Errors e = fly_path(path, 8 * geo::unit(i * geo::kPi / 4));
    worst = {std::max(worst.straight, e.straight), std::max(worst.turn, e.turn)};
  }
  const Errors calm = fly_path(path, Vec2::Zero());
  EXPECT_LT(calm.straight, 1);
  EXPECT_LT(calm.turn, 5);
  std::printf("turns of %.0f m: straights %.2f m, turns %.2f m; calm %.2f, %.2f\n",
              radius, worst.straight, worst.turn, calm.straight, calm.turn);
  return worst;
}

TEST(SimpleAutopilot, TracksTurnsThatCanBeFlownAtCruise) {
  const Errors worst = worst_in_wind(model::ground_turn_radius(kRadius, kAirspeed, 8));
  EXPECT_LT(worst.straight, 1);
  EXPECT_LT(worst.turn, 3);
}

TEST(SimpleAutopilot, SlowsDownForTighterTurns) {
  const Errors worst = worst_in_wind(1.5 * kRadius);
  EXPECT_LT(worst.straight, 3);
  EXPECT_LT(worst.turn, 15);
}

TEST(SimpleAutopilot, HoldsACourseOverGround) {
  for (const double course : {0.5, 2.0, -2.5}) {
    Flight flight({0, 8});
    flight.fly(20);
    flight.autopilot->command({HoldCourse{course}, 300});
    flight.fly(30);
    const Vec2 start = flight.position();
    flight.fly(20);
    EXPECT_NEAR(geo::wrap_pi(geo::bearing(flight.position() - start) - course), 0, 1e-3);
  }
}

TEST(SimpleAutopilot, CirclesInBothSenses) {
  for (const bool clockwise : {true, false}) {
    Flight flight({6, 3});
    flight.fly(20);
    flight.autopilot->command({Circle{{300, 200}, 150, clockwise}, 300});
    flight.fly(90);
    double worst = 0, turned = 0;
    Vec2 last = flight.position() - Vec2(300, 200);
    flight.fly(60, [&] {
      const Vec2 now = flight.position() - Vec2(300, 200);
      worst = std::max(worst, std::abs(now.norm() - 150));
      turned += std::asin(geo::cross(last, now) / (last.norm() * now.norm()));
      last = now;
    });
    EXPECT_LT(worst, 8);
    EXPECT_GT(clockwise ? turned : -turned, 6);
  }
}

TEST(SimpleAutopilot, HoldsAltitude) {
  Flight flight({0, 0});
  flight.autopilot->command({HoldCourse{0}, 400});
  flight.fly(60);
  EXPECT_NEAR(-flight.vehicle.p.z(), 400, 0.5);
  flight.autopilot->command({HoldCourse{0}, 350});
  flight.fly(60);
  EXPECT_NEAR(-flight.vehicle.p.z(), 350, 0.5);
}

TEST(SimpleAutopilot, CirclesThePathsEnd) {
  Flight flight({5, 0});
  flight.fly(10);
  flight.vehicle.p = {0, 0, -300};
  flight.vehicle.heading = 0;
  flight.fly(0.5);
  flight.autopilot->command({FollowPath{join({{400, 0}})}, 300});
  EXPECT_NEAR(flight.autopilot->status().remaining, 400, 1e-9);
  flight.fly(5);
  EXPECT_FALSE(flight.autopilot->status().done);
  EXPECT_LT(flight.autopilot->status().remaining, 300);
  flight.fly(15);
  EXPECT_TRUE(flight.autopilot->status().done);
  flight.fly(60);
  double furthest = 0;
  flight.fly(60, [&] {
    furthest = std::max(furthest, (flight.position() - Vec2(400, 0)).norm());
  });
  EXPECT_LT(furthest, 150);  // radius 1.1 * 60 * 1.25^2 = 103 m, and a turn to join
}

TEST(SimpleAutopilot, ARepeatedPathGoesOnWithItsNewAltitude) {
  Flight once({0, 0}), often({0, 0});
  const Path path = join({{400, 0}, {200, 0.01}, {100, 0}});
  once.autopilot->command({FollowPath{path}, 310});
  for (int i = 0; i < 30; ++i) {
    often.autopilot->command({FollowPath{path}, 310});
    once.fly(1);
    often.fly(1);
  }
  EXPECT_EQ(once.vehicle.p, often.vehicle.p);
  EXPECT_FALSE(often.autopilot->status().done);
  often.autopilot->command({FollowPath{path}, 330});
  often.fly(20);
  EXPECT_TRUE(often.autopilot->status().done);
  EXPECT_NEAR(-often.vehicle.p.z(), 330, 1);
}

TEST(SimpleAutopilot, EmptyPathIsDoneAtOnce) {
  Flight flight({0, 0});
  flight.autopilot->command({FollowPath{}, 300});
  EXPECT_TRUE(flight.autopilot->status().done);
  flight.fly(60);
  EXPECT_LT(flight.position().norm(), 200);
}

TEST(SimpleAutopilot, LearnsTheWind) {
  Flight flight({-5, 6});
  flight.fly(40);
  EXPECT_LT((flight.autopilot->estimate().wind_N - Vec2(-5, 6)).norm(), 0.1);
  // A change arrives with the stated lag: 1 - 1/e of it after 15 s.
  flight.vehicle.wind = {5, 6};
  flight.fly(15);
  EXPECT_NEAR(flight.autopilot->estimate().wind_N.x(), 5 - 10 * std::exp(-1.0), 0.5);
}

TEST(SimpleAutopilot, EstimatesBetterThanTheFixesAndStatesTheirError) {
  Flight flight({4, 0});
  flight.fix_sd = 3;
  flight.fly(30);
  double sum2 = 0;
  int n = 0;
  flight.fly(120, [&] {
    sum2 += (geo::horizontal(flight.autopilot->estimate().p_N) - flight.position())
                .squaredNorm();
    ++n;
  });
  EXPECT_LT(std::sqrt(sum2 / n / 2), 2.0);  // white errors: averaging must help
  EXPECT_GE(flight.autopilot->estimate().position_sd, 3);
}

TEST(SimpleAutopilot, CarriesOnWithoutFixes) {
  Flight flight({4, -3});
  flight.fly(40);
  flight.gnss_off = true;
  flight.autopilot->command({HoldCourse{1}, 300});
  flight.fly(60);
  const NavEstimate& nav = flight.autopilot->estimate();
  // A steady wind known to 0.01 m/s, and one step of latency at 20 m/s.
  EXPECT_LT((geo::horizontal(nav.p_N) - flight.position()).norm(), 3);
  EXPECT_GT(nav.position_sd, 2);  // 0.3 sqrt(60)
  EXPECT_GT(nav.altitude_sd, 2);
}

TEST(SimpleAutopilot, FliesAPlanInTime) {
  Flight flight({3, 2});
  flight.fly(20);
  flight.vehicle.p = {0, 0, -300};
  flight.vehicle.heading = 0;
  flight.fly(0.5);
  const double now = flight.autopilot->estimate().time.seconds();
  // Half a turn of 100 m between straights, at 19 m/s over ground, climbing 1 m/s; a
  // second late at the start.
  const Path path = join({{400, 0}, {geo::kPi * 100, 0.01}, {400, 0}});
  Plan plan;
  for (double s = 0; s < model::length(path); s += 40) {
    const model::Pose at = model::pose_at(path, s);
    const Vec2 v = 19 * geo::unit(at.course);
    plan.push_back({Time::from_seconds(now - 1 + s / 19),
                    {at.position.x(), at.position.y(), -300 - s / 19},
                    {v.x(), v.y(), -1}});
  }
  flight.autopilot->command({FollowPlan{plan}, 0, {}});
  ASSERT_EQ(flight.autopilot->status().refused, "");
  flight.fly(25);
  double track = 0, late = 0, low = 0;
  const double left = plan.back().time.seconds() - now - 26;
  flight.fly(left, [&] {
    const AutopilotStatus& status = flight.autopilot->status();
    EXPECT_TRUE(status.follows);
    track = std::max(track, std::abs(status.cross_track));
    late = std::max(late, std::abs(status.time_error));
    const double time = static_cast<double>(flight.tick) * kStep;
    const double planned = 300 + time - status.time_error - now + 1;
    low = std::max(low, std::abs(-flight.vehicle.p.z() - planned));
  });
  std::printf("plan: track %.2f m, time %.2f s, altitude %.2f m\n", track, late, low);
  EXPECT_LT(track, 2);
  EXPECT_LT(late, 1);  // airspeed with a lag of 2 s through a turn in 3.6 m/s of wind
  EXPECT_LT(low, 1);
  flight.fly(10);
  EXPECT_TRUE(flight.autopilot->status().done);
}

TEST(SimpleAutopilot, FliesWaypointsReturnsAndComesDownTo30Metres) {
  Flight flight({0, 5});
  flight.fly(20);
  flight.autopilot->command(
      {FlyWaypoints{{{{600, 0}, 320}, {{600, 600}, 310}, {{0, 600}, 300}}, 2}, 0, {}});
  double nearest = 1e9;
  flight.fly(320, [&] {
    nearest = std::min(nearest, (flight.position() - Vec2(600, 600)).norm());
  });
  EXPECT_TRUE(flight.autopilot->status().done);
  EXPECT_LT(nearest, 60);  // rounded with 1.1 * 60 * 1.25^2 = 103 m: 43 m inside
  EXPECT_LT((flight.position() - Vec2(0, 600)).norm(), 150);

  flight.autopilot->command({Return{}, 300, {}});
  flight.fly(120);
  EXPECT_LT(flight.position().norm(), 150);
  EXPECT_NEAR(-flight.vehicle.p.z(), 360, 1);  // 60 m above where it began

  flight.autopilot->command({TakeOff{}, 380, {}});  // from the air: a climb
  flight.fly(60);
  EXPECT_TRUE(flight.autopilot->status().done);
  EXPECT_NEAR(-flight.vehicle.p.z(), 380, 1);

  flight.autopilot->command({Land{{100, 100}, 250, {}}, 0, {}});
  double lowest = 1e9;
  for (int i = 0; i < 600 && !flight.autopilot->status().done; ++i) flight.fly(1);
  EXPECT_TRUE(flight.autopilot->status().done);
  flight.fly(60, [&] { lowest = std::min(lowest, -flight.vehicle.p.z()); });
  EXPECT_NEAR(lowest, 280, 3);  // overshoots by its altitude gain: 1.8 m/s / 0.3
  EXPECT_NEAR(-flight.vehicle.p.z(), 280, 0.5);
  EXPECT_LT((flight.position() - Vec2(100, 100)).norm(), 150);
}

TEST(SimpleAutopilot, KeepsHomeAndItsLastCommandWhenItComesBack) {
  const auto back_at = [](Flight& flight, const Vec3& p) {
    flight.vehicle.p = p;
    flight.vehicle.roll = 0;
    NavEstimate start;
    start.time = Time::from_ns(flight.tick * 20'000'000LL);
    start.p_N = p;
    start.v_N = flight.vehicle.velocity();
    start.heading = flight.vehicle.heading;
    flight.autopilot->begin(start, false);
  };
  Flight held({0, 0});
  held.autopilot->command({HoldCourse{1}, 330});
  held.fly(10);
  held.vehicle.heading = -1;
  back_at(held, {3000, 1000, -300});
  held.fly(60);
  EXPECT_NEAR(held.vehicle.heading, 1, 0.02);
  EXPECT_NEAR(-held.vehicle.p.z(), 330, 1);

  // Both what it flies itself and what shared guidance flies know the first home.
  for (const bool commanded : {false, true}) {
    Flight flight({0, 0});
    if (commanded) flight.autopilot->command({Return{}, 300});
    flight.fly(10);
    back_at(flight, {3000, 1000, -300});
    flight.fly(400);
    EXPECT_LT(flight.position().norm(), 3 * kRadius) << commanded;
  }
}

TEST(SimpleAutopilot, RefusesAPlanItCannotFlyAndGoesOn) {
  Flight flight({0, 0});
  flight.autopilot->command({HoldCourse{1}, 300, {}});
  flight.fly(20);
  flight.autopilot->command({FollowPlan{}, 0, {}});
  EXPECT_EQ(flight.autopilot->status().refusals, 1);
  EXPECT_EQ(flight.autopilot->status().refused, "the plan is empty");
  flight.fly(10);
  EXPECT_NEAR(flight.vehicle.heading, 1, 1e-3);
  flight.autopilot->command({HoldCourse{0}, 300, {}});
  EXPECT_EQ(flight.autopilot->status().refusals, 1);
}

TEST(SimpleAutopilot, RefusesNumbersThatAreNotFinite) {
  Flight flight({0, 0});
  flight.autopilot->command({HoldCourse{1}, 300, {}});
  const double nan = std::nan("");
  const double infinite = std::numeric_limits<double>::infinity();
  const std::vector<AutopilotCommand> wrong = {
      {HoldCourse{nan}, 300, {}},
      {HoldCourse{0}, infinite, {}},
      {HoldCourse{0}, 300, nan},
      {HoldPosition{{nan, 0}}, 300, {}},
      {Circle{{0, 0}, infinite, true}, 300, {}},
      {FollowPath{{{{0, nan}, 0, 100, 0}}}, 300, {}}};
  for (const AutopilotCommand& command : wrong) flight.autopilot->command(command);
  EXPECT_EQ(flight.autopilot->status().refusals, static_cast<int>(wrong.size()));
  flight.fly(20);
  EXPECT_NEAR(flight.vehicle.heading, 1, 1e-3);
}

TEST(SimpleAutopilot, ReturnsToThePlaceThatWasSet) {
  NavEstimate start;
  start.p_N = {0, 0, -300};
  start.v_N = {20, 0, 0};
  SimpleAutopilot autopilot({}, FlightLimits{}, start);
  const auto remaining = [&](double time) {
    static_cast<void>(autopilot.control(Time::from_seconds(time), 0.1));
    return autopilot.status().remaining;
  };
  autopilot.command({Return{}, 300, {}});
  EXPECT_LT(remaining(0.1), 1);
  autopilot.set_return({{{0, 500}, {3000, 0}}, 0});
  EXPECT_NEAR(remaining(0.2), 3000, 100);
  autopilot.command({Return{}, 320, {}});
  EXPECT_NEAR(remaining(0.3), 3000, 100);
  autopilot.set_return({});
  EXPECT_LT(remaining(0.4), 10);
}

}  // namespace
}  // namespace skein::autopilot::simple_autopilot_test
