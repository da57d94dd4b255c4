// SPDX-License-Identifier: Apache-2.0
// The control loops close over the real plants, in the wind: true state, no estimator.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "skein/assemble/test/control_flight.h"
#include "skein/layer/asset/fixed_wing/fixed_wing_plant.h"
#include "skein/layer/asset/fixed_wing/test/aircraft.h"
#include "skein/layer/autopilot/control/fixed_wing_control.h"
#include "skein/layer/autopilot/guidance/fixed_wing_guidance.h"

namespace skein::control_flight_test {
namespace {

using autopilot::FixedWingControl;
using autopilot::FixedWingDemand;
using autopilot::FlightPhase;

FixedWingAirframe airframe_of(const asset::FixedWingPlant& plant) {
  return std::get<FixedWingAirframe>(plant.airframe());
}

// How far height and airspeed were from their demand.
struct Errors {
  double height_rms = 0, max_height = 0, airspeed_rms = 0, max_airspeed = 0;
  bool lost = false;  // upside down, in the ground, or out of numbers
};

// A minute of level flight with turns of 4 m/s^2 to either side, or none.
Errors fly(const asset::FixedWingPlant& plant, const FixedWingAirframe& airframe,
           double span, const Vec3& wind, double wind_6m, bool turns,
           std::uint64_t seed) {
  constexpr double kSettled = 5;
  Flight flight(plant, wind, wind_6m, span, seed);
  FixedWingControl control(airframe, {});
  FixedWingDemand demand;
  demand.altitude_msl = kHeight;
  demand.airspeed = airframe.cruise;
  Errors errors;
  int count = 0;
  for (double t = 0; t < 60; t += kStep) {
    if (turns) demand.lateral_acceleration = std::fmod(t, 20) < 10 ? 4 : -4;
    flight.step(control.control(demand, flight.nav(), kStep));
    const VehicleState& s = flight.state;
    if (!(s.p_N.z() < 0) || !(geo::down_in_body(s.q_NB).z() > 0)) {
      errors.lost = true;
      return errors;
    }
    if (t < kSettled) continue;
    const double height = -s.p_N.z() - kHeight, airspeed = s.airspeed - airframe.cruise;
    errors.height_rms += height * height;
    errors.airspeed_rms += airspeed * airspeed;
    errors.max_height = std::max(errors.max_height, std::abs(height));
    errors.max_airspeed = std::max(errors.max_airspeed, std::abs(airspeed));
    ++count;
  }
  errors.height_rms = std::sqrt(errors.height_rms / count);
  errors.airspeed_rms = std::sqrt(errors.airspeed_rms / count);
  return errors;
}

struct Aircraft {
  const char* name;
  asset::FixedWingParameters parameters;
};

std::vector<Aircraft> aircraft() {
  return {{"aerosonde", asset::aerosonde()}, {"glider", asset::glider()}};
}

TEST(FixedWingFlight, HoldsHeightAndAirspeedInTurnsWithoutTurbulence) {
  for (const auto& [name, parameters] : aircraft()) {
    const asset::FixedWingPlant plant(parameters);
    for (const bool turns : {false, true}) {
      const Errors e = fly(plant, airframe_of(plant), parameters.geometry.span,
                           Vec3(5, 0, 0), 0, turns, 1);
      ASSERT_FALSE(e.lost);
      // A turn is rolled into and out of within a second: measured 0.2 m and 0.15 m/s.
      EXPECT_LT(e.max_height, 0.5) << name;
      EXPECT_LT(e.max_airspeed, 0.3) << name;
    }
  }
}

TEST(FixedWingFlight, HoldsHeightAndAirspeedInLightTurbulence) {
  for (const auto& [name, parameters] : aircraft()) {
    const asset::FixedWingPlant plant(parameters);
    for (const bool turns : {false, true})
      for (std::uint64_t seed = 0; seed < 5; ++seed) {
        const Errors e = fly(plant, airframe_of(plant), parameters.geometry.span,
                             Vec3(3, -4, 0), kLight, turns, seed);
        ASSERT_FALSE(e.lost);
        // The goals: height at all times; airspeed in the mean square, as single gusts of
        // this turbulence (1.1 m/s standard deviation) are beyond what a motor can
        // follow.
        EXPECT_LT(e.max_height, 2) << name << ' ' << seed;
        EXPECT_LT(e.airspeed_rms, 1) << name << ' ' << seed;
      }
  }
}

// The parameters with errors of 10 %, drawn until they make an aircraft that can fly.
asset::FixedWingParameters with_errors(const asset::FixedWingParameters& nominal,
                                       RandomStream& random) {
  asset::FixedWingParameters p;
  do {
    p = nominal;
    asset::AeroCoefficients& a = p.aero;
    for (double* x :
         {&p.mass, &a.CL0,  &a.CLa,        &a.CLq,        &a.CLde,      &a.CD0,  &a.K,
          &a.Cma,  &a.Cmq,  &a.Cmde,       &a.CYb,        &a.CYda,      &a.CYdr, &a.Clb,
          &a.Clp,  &a.Clr,  &a.Clda,       &a.Cldr,       &a.Cnb,       &a.Cnp,  &a.Cnr,
          &a.Cnda, &a.Cndr, &p.inertia.xx, &p.inertia.yy, &p.inertia.zz})
      *x *= random.uniform(0.9, 1.1);
  } while (!asset::errors(p).empty());
  return p;
}

TEST(FixedWingFlight, SurvivesSevereTurbulenceWithWrongParameters) {
  std::vector<Aircraft> all = aircraft();
  all.push_back({"light sport", asset::light_sport()});
  for (const auto& [name, parameters] : all) {
    const FixedWingAirframe assumed = airframe_of(asset::FixedWingPlant(parameters));
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
      RandomStream random(seed, 0, Purpose::kTest);
      const asset::FixedWingPlant plant(with_errors(parameters, random));
      const Errors e = fly(plant, assumed, parameters.geometry.span, Vec3(-8, 0, 0),
                           kSevere, seed % 2 == 0, seed);
      EXPECT_FALSE(e.lost) << name << ' ' << seed;
    }
  }
}

// Follows a demand that jumps from the start; the state each step.
template <class Look>
void jump(const asset::FixedWingPlant& plant, const FixedWingDemand& demand, double time,
          Look look) {
  Flight flight(plant, Vec3::Zero(), 0, 1, 0);
  FixedWingControl control(airframe_of(plant), {});
  for (double t = 0; t < time; t += kStep) {
    const Actuators u = control.control(demand, flight.nav(), kStep);
    flight.step(u);
    look(flight.state, u);
  }
}

TEST(FixedWingFlight, StepsDoNotOvershoot) {
  for (const auto& [name, parameters] : aircraft()) {
    const asset::FixedWingPlant plant(parameters);
    const double cruise = airframe_of(plant).cruise;
    double top = 0, fastest = 0, bank = 0, last = 0;
    jump(plant, {0, kHeight + 10, 0, cruise}, 40,
         [&](const VehicleState& s, const auto&) {
           top = std::max(top, -s.p_N.z() - kHeight);
           fastest = std::max(fastest, std::abs(s.airspeed - cruise));
           last = -s.p_N.z() - kHeight;
         });
    EXPECT_LT(top, 11) << name;  // a tenth
    EXPECT_NEAR(last, 10, 0.2) << name;
    EXPECT_LT(fastest, 2) << name;
    fastest = 0;
    jump(plant, {0, kHeight, 0, cruise + 2}, 40, [&](const VehicleState& s, const auto&) {
      fastest = std::max(fastest, s.airspeed - cruise);
      last = s.airspeed - cruise;
    });
    EXPECT_LT(fastest, 2.2) << name;
    EXPECT_NEAR(last, 2, 0.1) << name;
    jump(plant, {5, kHeight, 0, cruise}, 20, [&](const VehicleState& s, const auto&) {
      last = geo::to_euler(s.q_NB).roll;
      bank = std::max(bank, last);
    });
    const double setpoint = std::atan(5 / kGravity);
    EXPECT_LT(bank, 1.1 * setpoint) << name;
    EXPECT_NEAR(last, setpoint, 0.01) << name;
  }
}

TEST(FixedWingFlight, TurnsWithoutSideslip) {
  for (const auto& [name, parameters] : aircraft()) {
    const asset::FixedWingPlant plant(parameters);
    double sideslip = 0;
    jump(plant, {5, kHeight, 0, airframe_of(plant).cruise}, 20,
         [&](const VehicleState& s, const auto&) {
           sideslip = (s.q_NB.conjugate() * s.v_N).y() / s.airspeed;
         });
    EXPECT_LT(std::abs(sideslip), 0.03) << name;  // without rudder twice that
  }
}

TEST(FixedWingFlight, TracksTheGroundInWindAsAsked) {
  // A lateral acceleration across the ground track bends the ground track: a quarter of a
  // circle over ground needs V_g / a per radian.
  const asset::FixedWingPlant plant(asset::aerosonde());
  const Vec3 wind(0, 8, 0);
  Flight flight(plant, wind, 0, 1, 0);
  FixedWingControl control(airframe_of(plant), {});
  const Vec2 start = geo::horizontal(flight.state.v_N);
  double due = geo::bearing(start);
  for (double t = 0; t < 15; t += kStep) {
    const FixedWingDemand demand{3, kHeight, 0, 25};
    due += 3 / geo::horizontal(flight.state.v_N).norm() * kStep;
    flight.step(control.control(demand, flight.nav(), kStep));
  }
  // Late by the time to roll in, 0.6 s of 0.12 rad/s; the rest is the error.
  const double course = geo::bearing(geo::horizontal(flight.state.v_N));
  EXPECT_NEAR(geo::wrap_pi(course - due), -0.07, 0.07);
}

TEST(FixedWingFlight, GlidesAtTheAirspeedWhenTheMotorStands) {
  for (const auto& [name, parameters] : aircraft()) {
    const asset::FixedWingPlant plant(parameters);
    const FixedWingAirframe airframe = airframe_of(plant);
    Flight flight(plant, Vec3(5, 0, 0), kLight, 1.5, 3);
    flight.state.p_N.z() = -400;
    flight.state.faults.dead = 1u << channel::kThrottle;
    FixedWingControl control(airframe, {});
    FixedWingDemand demand{0, 400, 0, airframe.cruise, FlightPhase::kGlide};
    double min = 1e9, sum = 0;
    int count = 0;
    for (double t = 0; t < 40; t += kStep) {
      demand.lateral_acceleration = t < 20 ? 0 : 3;
      flight.step(control.control(demand, flight.nav(), kStep));
      min = std::min(min, flight.state.airspeed);
      if (t > 10) {
        sum += flight.state.airspeed;
        ++count;
      }
    }
    EXPECT_GT(min, airframe.slowest) << name;
    EXPECT_NEAR(sum / count, airframe.cruise, 0.5) << name;
  }
}

TEST(FixedWingFlight, GivesUpHeightBeforeAirspeedWhereTheMotorIsTooWeak) {
  // Asked to climb for ever with a dead motor, in the phase of normal flight.
  const asset::FixedWingPlant plant(asset::glider());
  const FixedWingAirframe airframe = airframe_of(plant);
  Flight flight(plant, Vec3::Zero(), 0, 1.5, 0);
  flight.state.p_N.z() = -400;
  flight.state.faults.dead = 1u << channel::kThrottle;
  FixedWingControl control(airframe, {});
  double min = 1e9;
  for (double t = 0; t < 40; t += kStep) {
    flight.step(control.control({0, 500, 0, airframe.cruise}, flight.nav(), kStep));
    min = std::min(min, flight.state.airspeed);
  }
  // At 0.88 of the minimum airspeed, which has a reserve to the stall, pitch serves it
  // alone.
  EXPECT_GT(min, 0.88 * airframe.slowest);
}

TEST(FixedWingFlight, LeavesAStall) {
  // Sinking air takes height and speed for a while; then rising air stalls the wing.
  const asset::FixedWingPlant plant(asset::glider());
  const FixedWingAirframe airframe = airframe_of(plant);
  const auto alpha = [](const VehicleState& s, const Vec3& wind) {
    const Vec3 v_B = s.q_NB.conjugate() * (s.v_N - wind);
    return std::atan2(v_B.z(), v_B.x());
  };
  for (const double rising : {0.0, 1.0, 2.0, 3.0, 5.0, 7.0}) {
    VehicleState s = plant.start({Vec3(0, 0, -kHeight), 0, Vec3::Zero(), false});
    FixedWingControl control(airframe, {});
    double max = 0, after = 0;
    for (double t = 0; t < 30; t += kStep) {
      Air air;
      air.wind_N.z() = t < 14 ? 6 : t < 24 ? -rising : 0;
      const Actuators u = control.control({0, kHeight, 0, airframe.cruise},
                                          truth(s, Vec3::Zero()), kStep);
      plant.step(s, u, air, kStep);
      if (t > 14) max = std::max(max, alpha(s, air.wind_N));
      if (t > 18) after = std::max(after, alpha(s, air.wind_N));
    }
    EXPECT_GT(max, 0.3) << "it has stalled: " << rising;
    EXPECT_LT(after, 0.2) << rising;
    EXPECT_GT(-s.p_N.z(), kHeight - 40) << rising;
  }
}

TEST(FixedWingFlight, ChangesHandsWithoutAJump) {
  const asset::FixedWingPlant plant(asset::glider());
  const FixedWingAirframe airframe = airframe_of(plant);
  Flight flight(plant, Vec3(5, 0, 0), 0, 1.5, 0);
  FixedWingControl control(airframe, {});
  PilotInput sticks;
  sticks.roll = 0.4;
  sticks.pitch = 0.3;
  sticks.throttle = 0.9;
  Actuators last;
  for (double t = 0; t < 4; t += kStep) {
    last = control.stabilize(control.attitude_for(sticks), flight.nav(), kStep);
    flight.step(last);
  }
  control.reset(flight.nav());
  const double bank = geo::to_euler(flight.state.q_NB).roll;
  const FixedWingDemand demand{kGravity * std::tan(bank), -flight.state.p_N.z(), 0,
                               airframe.cruise};
  for (double t = 0; t < 0.1; t += kStep) {
    const Actuators now = control.control(demand, flight.nav(), kStep);
    // In a step: the throttle's rate, and what its rates ask of the pitch.
    for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(now[k], last[k], 0.05) << k;
    flight.step(now);
    last = now;
  }
}

// Lateral acceleration that keeps to the line to the north.
double along_north(const VehicleState& s) {
  const double speed = std::max(geo::horizontal(s.v_N).norm(), 1.0);
  const double course = speed > 1.5 ? geo::bearing(geo::horizontal(s.v_N)) : 0;
  return std::clamp(speed * (-std::atan(s.p_N.y() / (3 * speed)) - course), -3.0, 3.0);
}

TEST(FixedWingFlight, TakesOff) {
  for (const auto& [name, parameters] : aircraft()) {
    const asset::FixedWingPlant plant(parameters);
    const FixedWingAirframe airframe = airframe_of(plant);
    for (const Vec3& wind : {Vec3(0, 0, 0), Vec3(-5, 0, 0), Vec3(0, 3, 0)}) {
      VehicleState s = plant.start({Vec3::Zero(), 0, wind, true});
      FixedWingControl control(airframe, {});
      FixedWingDemand demand{0, 60, 0, airframe.cruise, FlightPhase::kRun};
      double aside = 0, slowest = 1e9;
      bool crashed = false;
      for (double t = 0; t < 60; t += kStep) {
        const double height = -s.p_N.z();
        if (demand.phase == FlightPhase::kRun && s.airspeed > 1.1 * airframe.slowest)
          demand.phase = FlightPhase::kClimbOut;
        if (demand.phase == FlightPhase::kClimbOut && height > 40)
          demand.phase = FlightPhase::kFlight;
        demand.lateral_acceleration = along_north(s);
        Air air;
        air.wind_N = wind;
        plant.step(s, control.control(demand, truth(s, wind), kStep), air, kStep);
        if (-s.p_N.z() < 0 && plant.touch(s, 0, kStep) == Contact::kCrash) crashed = true;
        aside = std::max(aside, std::abs(s.p_N.y()));
        if (demand.phase != FlightPhase::kRun) slowest = std::min(slowest, s.airspeed);
      }
      EXPECT_FALSE(crashed) << name;
      EXPECT_NEAR(-s.p_N.z(), 60, 0.5) << name;
      EXPECT_LT(aside, 4) << name;  // in wind across the runway
      EXPECT_GT(slowest, airframe.slowest) << name;
    }
  }
}

// A landing at the origin on a course to the north, as guidance flies it.
struct Landed {
  double sink = -1;  // at the first touch [m/s]
  double at = 0;     // north, at the first touch [m]
  double crab = 0;   // nose off the course over ground there, clockwise [rad]
  double aside = 0;  // maximum, from the touch on [m]
  bool crashed = false;
  VehicleState end;
};

Landed land(const asset::FixedWingPlant& plant, const Vec3& wind, double wind_6m,
            double span, std::uint64_t seed, bool aligns = true) {
  const FixedWingAirframe airframe = airframe_of(plant);
  Flight flight(plant, wind, wind_6m, span, seed);
  VehicleState& s = flight.state;
  s.p_N = {-60 * airframe.cruise, 0, -40};
  FixedWingControl control(airframe, {});
  autopilot::FixedWingGuidanceOptions options;
  options.landing.roll_friction = airframe.roll_friction;
  options.landing.brake_friction = airframe.brake_friction;
  options.landing.lift_off = control.setup().lift_off;
  if (!aligns) options.landing.align_height = 0;
  autopilot::FixedWingGuidance guidance(options, plant.limits(), Vec3::Zero());
  const auto motion = [&] { return autopilot::motion_of(flight.nav(), -s.p_N.z()); };
  EXPECT_FALSE(guidance.command({Land{Vec2::Zero(), 0, 0.0}, 40, {}}, motion()));
  Landed landed;
  for (double t = 0; t < 200; t += kStep) {
    flight.step(control.control(guidance.step(motion(), kStep), flight.nav(), kStep));
    if (-s.p_N.z() >= 0) continue;
    if (landed.sink < 0) {
      landed.sink = s.v_N.z();
      landed.at = s.p_N.x();
      landed.crab = geo::wrap_pi(geo::yaw(s.q_NB) - geo::bearing(geo::horizontal(s.v_N)));
    }
    landed.aside = std::max(landed.aside, std::abs(s.p_N.y()));
    if (plant.touch(s, 0, kStep) == Contact::kCrash) landed.crashed = true;
  }
  landed.end = s;
  return landed;
}

TEST(FixedWingFlight, LandsSoftly) {
  for (const auto& [name, parameters] : aircraft()) {
    const asset::FixedWingPlant plant(parameters);
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
      const Landed landed = land(plant, Vec3(-5, 0, 0), seed == 0 ? 0 : kLight,
                                 parameters.geometry.span, seed);
      EXPECT_FALSE(landed.crashed) << name << ' ' << seed;
      // It breaks above 2.5.
      EXPECT_LT(landed.sink, seed == 0 ? 1.0 : 2.4) << name << ' ' << seed;
      // Before the point, by its roll-out; in rising air it floats.
      EXPECT_NEAR(landed.at, 0, 170) << name << ' ' << seed;
      EXPECT_LT(geo::horizontal(landed.end.v_N).norm(), 1) << name << ' ' << seed;
      // Brakes make up for a touch in the wrong place; a belly has none.
      EXPECT_LT(geo::horizontal(landed.end.p_N).norm(),
                parameters.ground.brake_friction > 0 ? 15 : 40)
          << name << ' ' << seed;
    }
  }
}

TEST(FixedWingFlight, TouchesDownOnWheelsAlongTheCourseInACrosswind) {
  for (const asset::FixedWingParameters& parameters :
       {asset::aerosonde(), asset::light_sport()})
    for (const double share : {-0.15, 0.15}) {
      const asset::FixedWingPlant plant(parameters);
      const Vec3 wind(0, share * parameters.envelope.cruise, 0);
      const auto landing = [&](bool aligns) {
        return land(plant, wind, 0, parameters.geometry.span, 0, aligns);
      };
      const Landed with = landing(true), without = landing(false);
      EXPECT_FALSE(with.crashed) << parameters.mass;
      EXPECT_LT(with.sink, 1) << parameters.mass;
      EXPECT_GT(std::abs(without.crab), 0.15) << "what there is to take out";
      EXPECT_LT(std::abs(with.crab), 0.65 * std::abs(without.crab)) << parameters.mass;
      EXPECT_LT(with.aside, 6) << parameters.mass;
    }
}

}  // namespace
}  // namespace skein::control_flight_test
