// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include "skein/layer/autopilot/guidance/multirotor_guidance.h"

namespace skein::autopilot {

/// A multirotor of these tests' own: a point whose acceleration follows, with a lag, that
/// of the reference plus what its errors ask for; flat ground that holds it up.
struct PointRotor {
  static constexpr double kStep = 0.01;  // [s]
  double lag = 0.15, max = 5;
  Vec3 p = {0, 0, -50}, v = Vec3::Zero(), a = Vec3::Zero();
  Vec2 wind = Vec2::Zero();
  double ground_msl = 0;
  Time time;

  static MultirotorAirframe airframe() {
    MultirotorAirframe a;
    a.mass = 1.5;
    a.tilt_limit = 0.6;
    a.cruise = 10;
    a.fastest = 15;
    a.climb_rate = 4;
    a.sink_rate = 3;
    return a;
  }
  NavState nav() const {
    NavState n;
    n.time = time;
    n.p_N = p;
    n.v_N = v;
    n.wind_N = {wind.x(), wind.y(), 0};
    n.airspeed = (v.head<2>() - wind).norm();
    return n;
  }
  void step(const MultirotorDemand& d) {
    time += Time::from_ns(10'000'000);
    Vec3 setpoint;
    const Vec2 off = d.holds_position ? Vec2(d.position - p.head<2>()) : Vec2(0, 0);
    setpoint.head<2>() = d.acceleration + 3 * (d.velocity - v.head<2>()) + 3 * off;
    setpoint.z() = -4 * (d.climb_rate + v.z()) - 4 * (d.altitude_msl + p.z());
    if (setpoint.norm() > max) setpoint *= max / setpoint.norm();
    a += (setpoint - a) * kStep / lag;
    p += kStep * (v + kStep / 2 * a);
    v += kStep * a;
    if (-p.z() <= ground_msl) {
      p.z() = -ground_msl;
      v.z() = std::min(v.z(), 0.0);
      v.head<2>().setZero();
    }
  }
};

}  // namespace skein::autopilot
