#include "layer/autopilot/guidance/fixed_wing_guidance.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <functional>

#include "layer/autopilot/guidance/test/point_wing.h"
#include "model/path/path_geometry.h"
#include "model/path/wind_triangle.h"

namespace skein::autopilot {
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
  std::optional<std::string> tell(const AutopilotCommand& command) {
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
  double sum2 = 0, most = 0;
  int n = 0;
  void add(double e) {
    sum2 += e * e;
    ++n;
    most = std::max(most, std::abs(e));
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
    EXPECT_FALSE(flight.tell({FollowPath{path}, 100}));
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
                  name(law), wind, a.straight.rms(), a.straight.most, a.turn.rms(),
                  a.turn.most);
      EXPECT_LT(a.straight.rms(), 1);
      EXPECT_LT(a.turn.rms(), 3);
    }
}

TEST(FixedWingGuidance, CirclesWithEachLaw) {
  for (const LateralLaw law : {LateralLaw::kCourse, LateralLaw::kL1, LateralLaw::kL2Plus})
    for (const double wind : {0.0, 5.0, 8.0})
      for (const bool clockwise : {true, false}) {
        Flight flight({0, wind}, with_law(law));
        EXPECT_FALSE(flight.tell({Circle{{300, 100}, 120, clockwise}, 100}));
        flight.fly(120);
        Errors errors;
        flight.fly(
            60, [&] { errors.add((flight.position() - Vec2(300, 100)).norm() - 120); });
        std::printf("%-6s circle %.0f m/s: rms %.2f max %.2f m\n", name(law), wind,
                    errors.rms(), errors.most);
        EXPECT_LT(errors.most, 1.5);
      }
}

}  // namespace
}  // namespace skein::autopilot
