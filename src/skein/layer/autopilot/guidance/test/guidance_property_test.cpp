// SPDX-License-Identifier: Apache-2.0
// Random commands and motions, flyable or not: whatever is accepted gives finite demands
// within the vehicle's limits, and what is refused leaves everything as it was.

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <limits>

#include "skein/layer/autopilot/guidance/fixed_wing_guidance.h"
#include "skein/layer/autopilot/guidance/multirotor_guidance.h"

namespace skein::autopilot::guidance_property_test {
namespace {

// Mostly sensible, sometimes zero, huge, tiny or not a number.
double number(double scale) {
  const int kind = *rc::gen::inRange(0, 60);
  const double share = *rc::gen::inRange(-1000, 1001) / 1000.0;
  if (kind == 0) return std::numeric_limits<double>::quiet_NaN();
  if (kind == 1) return std::numeric_limits<double>::infinity();
  if (kind == 2) return 1e9 * share;
  if (kind <= 5) return 0;
  if (kind <= 7) return 1e-9 * share;
  return scale * share;
}

Vec2 point(double scale) {
  const double x = number(scale);
  return {x, number(scale)};
}

Path path() {
  Path out;
  const int n = *rc::gen::inRange(0, 6);
  for (int i = 0; i < n; ++i)
    out.push_back({point(300), number(4), std::abs(number(200)), number(0.02)});
  return out;
}

Plan plan() {
  Plan out;
  const int n = *rc::gen::inRange(0, 6);
  double time = number(20);
  if (!std::isfinite(time)) time = 0;
  Vec2 p = point(100);
  for (int i = 0; i < n; ++i) {
    const Vec2 v = Vec2(15, 0) + point(4);
    out.push_back({Time::from_seconds(std::clamp(time, -1e6, 1e6)),
                   {p.x(), p.y(), -100 - number(20)},
                   {v.x(), v.y(), number(1)}});
    const double step = 4 + number(4);
    time += std::isfinite(step) ? step : 1;
    p += step * v;
  }
  return out;
}

AutopilotCommand command() {
  AutopilotCommand out;
  out.altitude_msl = 100 + number(50);
  if (*rc::gen::inRange(0, 4) == 0) out.airspeed = 15 + number(10);
  switch (*rc::gen::inRange(0, 9)) {
    case 0:
      out.guidance = FollowPath{path()};
      break;
    case 1:
      out.guidance = HoldCourse{number(7)};
      break;
    case 2:
      out.guidance = Circle{point(300), 80 + number(90), *rc::gen::arbitrary<bool>()};
      break;
    case 3:
      out.guidance = HoldPosition{point(500)};
      break;
    case 4:
      out.guidance = FollowPlan{plan()};
      break;
    case 5: {
      FlyWaypoints w;
      const int n = *rc::gen::inRange(0, 5);
      for (int i = 0; i < n; ++i) w.points.push_back({point(400), 100 + number(5)});
      w.laps = *rc::gen::inRange(0, 1000000);
      out.guidance = w;
      break;
    }
    case 6:
      out.guidance = TakeOff{number(4)};
      break;
    case 7:
      out.guidance = Land{point(400), number(20), std::nullopt};
      if (*rc::gen::arbitrary<bool>()) std::get<Land>(out.guidance).course = number(4);
      break;
    default:
      out.guidance = Return{};
  }
  return out;
}

// A finite motion, with the odd standstill and strong wind.
NavState motion(Time time) {
  const auto bounded = [](double scale) {
    const double x = number(scale);
    return std::isfinite(x) ? std::clamp(x, -1e5, 1e5) : 0.0;
  };
  NavState nav;
  nav.time = time;
  nav.p_N = {bounded(500), bounded(500), -100 + bounded(150)};
  nav.v_N = {bounded(20), bounded(20), bounded(3)};
  nav.wind_N = {bounded(12), bounded(12), bounded(1)};
  nav.q_NB = geo::from_euler({bounded(3), bounded(1.5), bounded(3)});
  nav.airspeed = std::abs(bounded(25));
  return nav;
}

TEST(GuidanceProperty, AFixedWingsDemandIsAlwaysFinite) {
  const FlightLimits limits{15, 40, 3, 11, 20, 3};
  const double max = 15.0 * 15 / 40;
  EXPECT_TRUE(rc::check([&] {
    FixedWingGuidanceOptions options;
    options.lateral.law = static_cast<LateralLaw>(*rc::gen::inRange(0, 3));
    options.rounds_corners = *rc::gen::arbitrary<bool>();
    options.landing.touches_down = *rc::gen::arbitrary<bool>();
    FixedWingGuidance guidance(options, limits, {0, 0, -50});
    Time time;
    for (int i = 0; i < 4; ++i) {
      const auto old = guidance.current();
      if (guidance.command(command(), motion_of(motion(time))))
        RC_ASSERT(old.guidance.index() == guidance.current().guidance.index());
      for (int k = 0; k < 6; ++k) {
        time += Time::from_ns(10'000'000);
        const FixedWingDemand d = guidance.step(motion_of(motion(time)), 0.01);
        RC_ASSERT(std::abs(d.lateral_acceleration) <= max);
        RC_ASSERT(std::isfinite(d.altitude_msl));
        RC_ASSERT(std::isfinite(d.climb_rate));
        const bool idle = d.airspeed == 0 && (d.phase == FlightPhase::kFlare ||
                                              d.phase == FlightPhase::kRollOut);
        RC_ASSERT(idle || (d.airspeed >= limits.slowest && d.airspeed <= limits.fastest));
        const AutopilotStatus& s = guidance.status();
        RC_ASSERT(std::isfinite(s.remaining) && s.remaining >= 0);
        RC_ASSERT(std::isfinite(s.cross_track) && std::isfinite(s.time_error));
      }
    }
  }));
}

TEST(GuidanceProperty, AMultirotorsDemandIsAlwaysFinite) {
  MultirotorAirframe airframe;
  airframe.cruise = 10;
  airframe.fastest = 20;
  airframe.climb_rate = 4;
  airframe.sink_rate = 3;
  EXPECT_TRUE(rc::check([&] {
    MultirotorGuidanceOptions options;
    options.corner_cut = *rc::gen::inRange(0, 3);
    MultirotorGuidance guidance(options, airframe, {0, 0, -50});
    Time time;
    for (int i = 0; i < 4; ++i) {
      guidance.command(command(), motion(time));
      for (int k = 0; k < 6; ++k) {
        time += Time::from_ns(10'000'000);
        const MultirotorDemand d = guidance.step(motion(time), 0.01);
        RC_ASSERT(d.position.allFinite() && d.velocity.allFinite());
        RC_ASSERT(d.acceleration.norm() <= options.acceleration + 1e-9);
        RC_ASSERT(std::isfinite(d.altitude_msl) && std::isfinite(d.heading));
        RC_ASSERT(d.climb_rate <= airframe.climb_rate + 1e-9);
        RC_ASSERT(d.climb_rate >= -airframe.sink_rate - 1e-9);
        const AutopilotStatus& s = guidance.status();
        RC_ASSERT(std::isfinite(s.remaining) && s.remaining >= 0);
        RC_ASSERT(std::isfinite(s.cross_track) && std::isfinite(s.time_error));
      }
    }
  }));
}

}  // namespace
}  // namespace skein::autopilot::guidance_property_test
