// SPDX-License-Identifier: Apache-2.0
#include "skein/role/plant_flight.h"

#include <fmt/format.h>

#include <cmath>

#include "skein/geo/rotation.h"

namespace skein {
namespace {

// Above this the ground is looked for once a flight only [m].
constexpr double kNearGround = 20;
// Ground that rises towards an aircraft faster than this is no runway [m/s].
constexpr double kHillside = 3;

// Adding up is enough: what is not finite stays so. (Overflow would be no flight either.)
bool finite(const VehicleState& s) {
  return std::isfinite(s.p_N.sum() + s.v_N.sum() + s.q_NB.coeffs().sum() +
                       s.w_NB_B.sum() + s.airspeed);
}

std::string motion_text(const VehicleState& s) {
  const geo::Euler a = geo::to_euler(s.q_NB);
  return fmt::format(
      "at {:.1f} m north, {:.1f} m east, {:.1f} m above sea level, {:.1f} m/s through "
      "the air, roll {:.0f}, pitch {:.0f}, heading {:.0f} deg, turning at {:.2f}, "
      "{:.2f}, {:.2f} rad/s",
      s.p_N.x(), s.p_N.y(), -s.p_N.z(), s.airspeed, geo::degrees(a.roll),
      geo::degrees(a.pitch), geo::degrees(geo::wrap_2pi(a.yaw)), s.w_NB_B.x(),
      s.w_NB_B.y(), s.w_NB_B.z());
}

}  // namespace

PlantFlight::PlantFlight(const std::string& name, const Plant& plant,
                         Turbulence* turbulence, VehicleState& state, Air& air,
                         const Terrain& terrain, const WindField& wind)
    : name_(name),
      plant_(plant),
      turbulence_(turbulence),
      state_(state),
      air_(air),
      terrain_(terrain),
      wind_(wind),
      before_(state),
      ground_(ground_below()),
      near_ground_(-state.p_N.z() - ground_ < kNearGround) {}

double PlantFlight::ground_below() const {
  return terrain_.elevation_msl(geo::horizontal(state_.p_N));
}

// The ground comes up too fast, because of the motion over it.
bool PlantFlight::hits_hillside() const {
  return geo::horizontal(state_.v_N).dot(terrain_.gradient(geo::horizontal(state_.p_N))) >
         kHillside;
}

std::optional<std::string> PlantFlight::step(Time now, const Control& control, double dt,
                                             bool last) {
  air_.wind_N = wind_.wind(state_.p_N, now);
  if (turbulence_) {
    const Gust gust =
        turbulence_->advance({now, state_, -state_.p_N.z() - ground_, air_.wind_N}, dt);
    air_.wind_N += gust.velocity_N;
    air_.rates_B = gust.rates_B;
  }
  plant_.step(state_, control, air_, dt);
  if (!finite(state_))
    return fmt::format("the motion of {} is no longer finite; before it was {}", name_,
                       motion_text(before_));
  if (near_ground_ || last) ground_ = ground_below();
  if (-state_.p_N.z() >= ground_) return std::nullopt;
  if (hits_hillside() || plant_.touch(state_, ground_, dt) == Contact::kCrash)
    return name_ + " hit the ground";
  return std::nullopt;
}

}  // namespace skein
