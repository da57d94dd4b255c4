// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

#include "skein/data/vehicle/air.h"
#include "skein/layer/autopilot/guidance/fixed_wing_guidance.h"

namespace skein::autopilot {

/// A fixed wing of these tests' own: a point with a bank that follows its demand with a
/// lag and a bounded rate, coordinated turns, airspeed and climb with lags, a steady wind
/// and flat ground. (Layers do not know each other, so the asset layer's plants are not
/// used here.)
struct PointWing {
  static constexpr double kStep = 0.01;  // [s]
  FlightLimits limits{15, 40, 3, 11, 20, 3};
  double roll_lag = 0.35, roll_rate = 1.5, airspeed_lag = 2;
  double friction = 1, brakes = 4;  // decelerations on the ground [m/s^2]
  Vec3 p = {0, 0, -100};
  double heading = 0, roll = 0, airspeed = 15, climb = 0;
  Vec2 wind = Vec2::Zero();
  double ground_msl = 0;
  bool on_ground = false;
  Time time;

  double bank_limit() const {
    return std::atan(limits.airspeed * limits.airspeed / (kGravity * limits.turn_radius));
  }
  Vec3 velocity() const {
    const double level = std::sqrt(std::max(airspeed * airspeed - climb * climb, 0.0));
    const Vec2 v = on_ground ? Vec2(airspeed * geo::unit(heading))
                             : Vec2(level * geo::unit(heading) + wind);
    return {v.x(), v.y(), -climb};
  }
  NavState nav() const {
    NavState n;
    n.time = time;
    n.p_N = p;
    n.v_N = velocity();
    n.q_NB = geo::from_euler({roll, 0, heading});
    n.wind_N = {wind.x(), wind.y(), 0};
    n.airspeed = airspeed;
    return n;
  }

  void step(const FixedWingDemand& d) {
    time += Time::from_ns(10'000'000);
    const Vec3 before = velocity();
    const Vec2 v = before.head<2>();
    const double drift = std::cos(geo::bearing(v) - heading);
    double setpoint =
        std::atan(d.lateral_acceleration / (kGravity * std::max(drift, 0.3)));
    double speed = d.airspeed;
    double rate = std::clamp(0.5 * (d.altitude_msl + p.z()) + d.climb_rate,
                             -limits.sink_rate, limits.climb_rate);
    if (d.phase == FlightPhase::kRun || on_ground) {
      setpoint = 0;
      rate = d.phase == FlightPhase::kClimbOut ? limits.climb_rate : 0;
    }
    if (d.phase == FlightPhase::kFlare) setpoint = 0, speed = 0.7 * limits.slowest;
    if (d.phase == FlightPhase::kFlare) rate = d.climb_rate;
    if (d.phase == FlightPhase::kGround || (on_ground && d.phase == FlightPhase::kFlare))
      speed = 0;
    if (d.phase == FlightPhase::kRollOut) {
      speed = airspeed;
      airspeed =
          std::max(airspeed - std::clamp(d.braking, friction, brakes) * kStep, 0.0);
    }
    setpoint = std::clamp(setpoint, -bank_limit(), bank_limit());
    roll += std::clamp((setpoint - roll) / roll_lag, -roll_rate, roll_rate) * kStep;
    airspeed += std::clamp((speed - airspeed) / airspeed_lag, -2.0, 2.0) * kStep;
    climb += (rate - climb) / 0.5 * kStep;
    heading += kGravity * std::tan(roll) / std::max(airspeed, 3.0) * kStep;
    p += kStep / 2 * (before + velocity());
    on_ground = -p.z() <= ground_msl + 1e-9 && climb <= 0.05;
    if (on_ground) p.z() = -ground_msl, climb = 0, roll = 0;
  }
};

}  // namespace skein::autopilot
