// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/autopilot/control/fixed_wing_control.h"

#include <utility>

#include "skein/base/math.h"
#include "skein/data/vehicle/air.h"
#include "skein/layer/autopilot/control/bounded.h"

namespace skein::autopilot {
namespace {

constexpr double kRunSteers = 4;  // ground speed for full use of a lateral demand [m/s]
constexpr double kWindy = 0.35;   // airspeed of a parked aircraft, over the slowest

// Adding up is enough: what is not finite stays so.
bool is_finite(const NavState& n) {
  return std::isfinite(n.p_N.sum() + n.v_N.sum() + n.q_NB.coeffs().sum() +
                       n.w_NB_B.sum() + n.wind_N.sum() + n.airspeed);
}

bool is_finite(const FixedWingDemand& d) {
  return std::isfinite(d.lateral_acceleration + d.altitude_msl + d.climb_rate +
                       d.airspeed);
}

// Forward axis over the ground, as a unit vector.
Vec2 heading_of(const Quat& q) {
  const Vec2 forward(q.w() * q.w() + q.x() * q.x() - q.y() * q.y() - q.z() * q.z(),
                     2 * (q.x() * q.y() + q.w() * q.z()));
  const double length = forward.norm();
  return length > 1e-9 ? Vec2(forward / length) : Vec2(1, 0);
}

EnergyView view_of(const NavState& nav, const Tilt& tilt) {
  return {-nav.p_N.z(), -nav.v_N.z(), nav.airspeed, (nav.v_N - nav.wind_N).norm(),
          tilt.load()};
}

}  // namespace

FixedWingControl::FixedWingControl(std::shared_ptr<const FixedWingSetup> setup)
    : setup_(std::move(setup)) {
  last_[channel::kElevator] = bounded(setup_->airframe.trim_elevator, 1);
}

FixedWingControl::FixedWingControl(const FixedWingAirframe& airframe,
                                   const FixedWingGains& gains)
    : FixedWingControl(std::make_shared<const FixedWingSetup>(airframe, gains)) {}

void FixedWingControl::reset(const NavState& nav) {
  if (!is_finite(nav)) {
    fresh_ = true;
    return;
  }
  const Tilt tilt(nav.q_NB);
  energy_.reset(view_of(nav, tilt), tilt.pitch,
                flown_ ? last_[channel::kThrottle] : setup_->airframe.trim_throttle);
  roll_ = tilt.roll;
  roll_rate_ = bounded(nav.w_NB_B.x(), setup_->gains.bank_rate_limit);
  run_heading_.setZero();
  fresh_ = false;
  flown_ = true;
}

void FixedWingControl::change(std::shared_ptr<const FixedWingSetup> setup) {
  setup_ = std::move(setup);
}

double FixedWingControl::bank_demand(const FixedWingDemand& demand,
                                     const NavState& nav) const {
  const FixedWingAirframe& a = setup_->airframe;
  const Vec2 ground = geo::horizontal(nav.v_N);
  const Vec2 air = geo::horizontal(nav.v_N - nav.wind_N);
  const double lengths = std::sqrt(ground.squaredNorm() * air.squaredNorm());
  const double drift_cosine = lengths > 1 ? ground.dot(air) / lengths : 1;
  // Lift carries a load of (V / slowest)^2; some bank is always left to turn with.
  const double lift = nav.airspeed * nav.airspeed / (a.slowest * a.slowest);
  double max =
      std::min(setup_->bank_tangent, std::sqrt(bounded(lift * lift - 1, 0.1, 1e4)));
  if (demand.phase == FlightPhase::kClimbOut)
    max = std::min(max, setup_->gains.climb_out_bank);
  if (demand.phase == FlightPhase::kFlare) max = std::min(max, setup_->gains.flare_bank);
  return math::atan(bounded(
      demand.lateral_acceleration / (kGravity * std::max(drift_cosine, 0.3)), max));
}

void FixedWingControl::move_roll(double aim, double dt) {
  const FixedWingGains& g = setup_->gains;
  const double step = g.bank_acceleration * dt;
  const double rate = bounded(g.bank_gain * (aim - roll_), g.bank_rate_limit);
  roll_rate_ = bounded(rate, roll_rate_ - step, roll_rate_ + step);
  roll_ = bounded(roll_ + roll_rate_ * dt, geo::kPi);
}

Actuators FixedWingControl::ground_run(const FixedWingDemand& setpoint,
                                       const NavState& nav, const Tilt& tilt, double dt) {
  const FixedWingAirframe& a = setup_->airframe;
  const bool takes_off = setpoint.phase == FlightPhase::kRun;
  const Vec2 heading = heading_of(nav.q_NB);
  if (run_heading_.isZero())
    run_heading_ = setpoint.heading.isZero() ? heading : setpoint.heading;
  const double speed = geo::horizontal(nav.v_N).norm();
  const double turn =
      bounded(setpoint.lateral_acceleration / std::max(speed, kRunSteers), 0.5);
  run_heading_ =
      (run_heading_ + turn * dt * geo::turned_right(run_heading_)).normalized();
  SurfaceDemand demand = without_lift();
  if (takes_off) demand.pitch = a.trim_alpha;
  demand.extra_turn =
      turn + setup_->gains.run_heading_gain * geo::cross(heading, run_heading_);
  surfaces_.reset();  // the ground holds against them
  surfaces_.step(*setup_, demand, nav, tilt, dt, last_);
  if (a.rudder && a.steering > 0) {
    const double by_wheels =
        demand.extra_turn / (a.steering * std::max(speed, kRunSteers));
    last_[channel::kRudder] = bounded(last_[channel::kRudder] - by_wheels, 1);
  }
  last_[channel::kThrottle] =
      a.motor && takes_off
          ? bounded(last_[channel::kThrottle] + setup_->gains.throttle_rate * dt, 0, 1)
          : 0;
  if (!takes_off && a.brake_friction > 0)
    last_[channel::kBrake] =
        bounded((setpoint.braking / kGravity - a.roll_friction) / a.brake_friction, 0, 1);
  energy_.follow(*setup_, view_of(nav, tilt), tilt.pitch, last_[channel::kThrottle], dt);
  move_roll(0, dt);
  return last_;
}

// On the ground gusts shall not lift it, and its weight brakes it.
SurfaceDemand FixedWingControl::without_lift() const {
  SurfaceDemand demand;
  demand.pitch = setup_->airframe.trim_alpha - setup_->alpha_per_load;
  demand.airspeed = energy_.airspeed();
  demand.lift_reserve = setup_->gains.lift_reserve;
  demand.carried = true;
  return demand;
}

Actuators FixedWingControl::stand(const NavState& nav, const Tilt& tilt, double dt) {
  const FixedWingAirframe& a = setup_->airframe;
  last_ = {};
  last_[channel::kElevator] = bounded(a.trim_elevator, 1);
  reset(nav);
  surfaces_.reset();
  // In a wind that could lift it, it is held down.
  if (nav.airspeed > kWindy * a.slowest)
    surfaces_.step(*setup_, without_lift(), nav, tilt, dt, last_);
  last_[channel::kBrake] = a.brake_friction > 0 ? 1 : 0;
  return last_;
}

Actuators FixedWingControl::control(const FixedWingDemand& demand, const NavState& nav,
                                    double dt) {
  if (!(dt > 0) || !is_finite(nav) || !is_finite(demand)) return last_;
  if (fresh_) reset(nav);
  const Tilt tilt(nav.q_NB);
  if (demand.phase == FlightPhase::kGround) return stand(nav, tilt, dt);
  last_[channel::kBrake] = 0;
  if (demand.phase == FlightPhase::kRun || demand.phase == FlightPhase::kRollOut)
    return ground_run(demand, nav, tilt, dt);
  run_heading_.setZero();
  move_roll(bank_demand(demand, nav), dt);
  const EnergyOutput energy = energy_.step(*setup_, demand, view_of(nav, tilt), dt);
  const FixedWingGains& g = setup_->gains;
  const double reserve =
      demand.phase == FlightPhase::kFlare ? g.flare_reserve : g.lift_reserve;
  SurfaceDemand surfaces{roll_, roll_rate_, energy.pitch, energy_.airspeed(), reserve};
  const bool aligns = demand.phase == FlightPhase::kFlare && demand.airspeed <= 0 &&
                      !demand.heading.isZero();
  if (aligns) {
    const Vec2 heading = heading_of(nav.q_NB);
    surfaces.off_heading =
        math::atan2(geo::cross(demand.heading, heading), demand.heading.dot(heading));
  }
  surfaces_.step(*setup_, surfaces, nav, tilt, dt, last_);
  last_[channel::kThrottle] = bounded(energy.throttle, 0, 1);
  return last_;
}

Actuators FixedWingControl::stabilize(const AttitudeDemand& demand, const NavState& nav,
                                      double dt) {
  if (!(dt > 0) || !is_finite(nav)) return last_;
  if (fresh_) reset(nav);
  const FixedWingAirframe& a = setup_->airframe;
  const Tilt tilt(nav.q_NB);
  move_roll(bounded(demand.roll, a.bank_limit), dt);
  SurfaceDemand surface;
  surface.roll = roll_;
  surface.roll_rate = roll_rate_;
  surface.airspeed = energy_.airspeed();
  surface.lift_reserve = setup_->gains.lift_reserve;
  surface.pitch =
      std::isfinite(demand.pitch) ? bounded(demand.pitch, a.pitch_down, a.pitch_up) : 0;
  surface.extra_turn = bounded(demand.yaw_rate, 1);
  surfaces_.step(*setup_, surface, nav, tilt, dt, last_);
  last_[channel::kThrottle] = a.motor ? bounded(demand.throttle, 0, 1) : 0;
  last_[channel::kBrake] = 0;
  energy_.follow(*setup_, view_of(nav, tilt), tilt.pitch, last_[channel::kThrottle], dt);
  return last_;
}

Actuators FixedWingControl::manual(const PilotInput& sticks, const NavState&, double) {
  const FixedWingAirframe& a = setup_->airframe;
  surfaces_.reset();
  fresh_ = true;
  last_[channel::kAileron] = bounded(sticks.roll, 1);
  last_[channel::kElevator] = bounded(a.trim_elevator - bounded(sticks.pitch, 1), 1);
  last_[channel::kRudder] = a.rudder ? -bounded(sticks.yaw, 1) : 0;
  last_[channel::kThrottle] = a.motor ? bounded(sticks.throttle, 0, 1) : 0;
  last_[channel::kBrake] = 0;
  return last_;
}

AttitudeDemand FixedWingControl::attitude_for(const PilotInput& sticks) const {
  const FixedWingAirframe& a = setup_->airframe;
  const double pitch = bounded(sticks.pitch, 1);
  AttitudeDemand demand;
  demand.roll = bounded(sticks.roll, 1) * a.bank_limit;
  demand.pitch = a.trim_alpha + (pitch > 0 ? pitch * (a.pitch_up - a.trim_alpha)
                                           : pitch * (a.trim_alpha - a.pitch_down));
  demand.yaw_rate = bounded(sticks.yaw, 1) * 0.3;
  demand.throttle = bounded(sticks.throttle, 0, 1);
  return demand;
}

}  // namespace skein::autopilot
