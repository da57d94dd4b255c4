// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "skein/base/random.h"
#include "skein/layer/autopilot/nav_state.h"
#include "skein/layer/environment/turbulence/dryden_turbulence.h"
#include "skein/role/plant.h"

namespace skein {

inline constexpr double kStep = 0.01;
inline constexpr double kHeight = 100;
// Wind at 6 m that makes light and severe turbulence in MIL-F-8785C: 15 and 45 knots.
inline constexpr double kLight = 7.72, kSevere = 23.15;

inline autopilot::NavState truth(const VehicleState& s, const Vec3& wind) {
  autopilot::NavState nav;
  nav.p_N = s.p_N;
  nav.v_N = s.v_N;
  nav.q_NB = s.q_NB;
  nav.w_NB_B = s.w_NB_B;
  nav.wind_N = wind;
  nav.airspeed = s.airspeed;
  return nav;
}

/// A plant in wind and turbulence.
class Flight {
 public:
  Flight(const Plant& plant, const Vec3& wind, double wind_6m, double span,
         std::uint64_t seed)
      : plant_(plant),
        wind_(wind),
        turbulence_({.wind20 = wind_6m, .span = span}, seed, EntityId{0}),
        state(plant.start({Vec3(0, 0, -kHeight), 0, wind, false})) {}

  autopilot::NavState nav() const { return truth(state, wind_); }

  void step(const Actuators& u) {
    const Gust gust = turbulence_.advance({now_, state, -state.p_N.z(), wind_}, kStep);
    Air air;
    air.wind_N = wind_ + gust.velocity_N;
    air.rates_B = gust.rates_B;
    plant_.step(state, u, air, kStep);
    now_ += Time::from_seconds(kStep);
  }

 private:
  const Plant& plant_;
  Vec3 wind_;
  environment::DrydenTurbulence turbulence_;
  Time now_;

 public:
  VehicleState state;
};

}  // namespace skein
