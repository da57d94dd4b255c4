// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/autopilot/control/surface_control.h"

#include "skein/data/vehicle/air.h"
#include "skein/layer/autopilot/control/bounded.h"

namespace skein::autopilot {
namespace {

constexpr double kMaxSum = 0.5;  // of an integrator, channel
// Nose up less: a wing that has stalled does not follow the elevator, and one that is
// held up for that stays stalled.
constexpr double kMaxNoseUp = 0.25;

// Adds to an integrator unless the channel is at its end and would be driven further.
void integrate(double& sum, double channel, double rate, double dt,
               double max = kMaxSum) {
  if ((channel < 1 || rate < 0) && (channel > -1 || rate > 0))
    sum = bounded(sum + rate * dt, -kMaxSum, max);
}

}  // namespace

void SurfaceControl::reset() {
  *this = SurfaceControl{};
}

void SurfaceControl::step(const FixedWingSetup& setup, const SurfaceDemand& demand,
                          const NavState& nav, const Tilt& at, double dt,
                          Actuators& out) {
  const FixedWingGains& g = setup.gains;
  const FixedWingAirframe& a = setup.airframe;
  const double speed = bounded(demand.airspeed, 0.5 * a.slowest, 2 * a.fastest);
  const double s = speed / a.cruise;
  const double pressure = s * s;

  const double turn = kGravity * at.sin_roll / (std::max(at.cos_roll, 0.3) * speed);
  const double roll_rate =
      bounded(g.roll_gain * geo::wrap_pi(demand.roll - at.roll) + demand.roll_rate,
              g.roll_rate_limit);
  const double pitch_rate =
      bounded(g.pitch_gain * (demand.pitch - at.pitch), g.pitch_rate_limit);
  const double p = roll_rate - at.sin_pitch * turn;
  const double level_load = at.cos_pitch * at.cos_roll;
  const double max_load = std::min(
      g.load_limit, demand.lift_reserve * (speed * speed) / (a.slowest * a.slowest));
  const double q = bounded(at.cos_roll * pitch_rate + at.cos_pitch * at.sin_roll * turn,
                           (-level_load) * kGravity / speed,
                           std::max(0.0, max_load - level_load) * kGravity / speed);
  const double r = level_load * turn - at.sin_roll * pitch_rate + demand.extra_turn;

  const double p_error = p - nav.w_NB_B.x();
  const double aileron = (a.roll_damping * s * p + g.roll_rate_gain * p_error) /
                             (a.aileron_power * pressure) +
                         roll_sum_;
  integrate(roll_sum_, aileron,
            g.roll_rate_integral * p_error / (a.aileron_power * pressure), dt);
  out[channel::kAileron] = bounded(aileron, 1);

  const double q_error = q - nav.w_NB_B.y();
  const double load = level_load + speed * q / kGravity;
  const double alpha =  // beyond that at cruise
      demand.carried ? bounded(at.pitch - a.trim_alpha, 3 * setup.alpha_per_load)
                     : setup.alpha_per_load * bounded(load / pressure - 1, -3, 3);
  const double nose_up = (a.pitch_stiffness * alpha + a.pitch_damping * q / s +
                          g.pitch_rate_gain * q_error / pressure) /
                             a.elevator_power -
                         a.trim_elevator + pitch_sum_;
  integrate(pitch_sum_, nose_up,
            g.pitch_rate_integral * q_error / (a.elevator_power * pressure), dt,
            kMaxNoseUp);
  out[channel::kElevator] = -bounded(nose_up, 1);

  if (!a.rudder) {
    out[channel::kRudder] = 0;
    return;
  }
  const double yaw_power = a.rudder_power * pressure;
  if (demand.off_heading) {
    // Hard against the weathercock: the sideslip that this makes is that of the wind.
    out[channel::kRudder] = bounded(g.align_gain * *demand.off_heading +
                                        g.align_rate_gain * nav.w_NB_B.z() / yaw_power,
                                    1);
    return;
  }
  // Sideslip from the estimated wind: weak, because the wind is known with errors.
  const Vec3 air_B = nav.q_NB.conjugate() * (nav.v_N - nav.wind_N);
  const double sideslip = bounded(air_B.y() / speed, 0.5);
  out[channel::kRudder] = -bounded(
      (g.yaw_rate_gain * (r - nav.w_NB_B.z()) + g.sideslip_gain * sideslip) / yaw_power,
      1);
}

}  // namespace skein::autopilot
