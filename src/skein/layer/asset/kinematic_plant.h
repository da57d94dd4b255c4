// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/role/plant.h"

namespace skein::asset {

struct KinematicOptions {
  /// The slowest airspeed that the aircraft is commanded to fly [m/s].
  double slowest() const { return airspeed * (1 - airspeed_range); }

  double airspeed = 20;          ///< cruise [m/s]
  double airspeed_range = 0.25;  ///< slowest and fastest are cruise (1 -+ this)
  double turn_radius = 60;       ///< smallest, in the air mass at cruise [m]
  double climb_rate = 3;         ///< largest, up and down; below slowest() [m/s]
  double roll_rate = 1;          ///< largest [rad/s]; 0 = the roll angle jumps
  double airspeed_lag = 2;       ///< time constant of the airspeed [s]; 0 = none
  double power = 0;              ///< always drawn [W]; 0 = no energy is counted
  double capacity_Wh = 0;        ///< of its store of energy [W h]; 0 = it never ends
  double glide_sink = 1.5;       ///< sinks at least so fast without power [m/s]
};

/// A point in the air mass in coordinated flight, carried by the wind.
///
///   heading' = g tan(roll) / V,   p' = V cos(gamma) (cos heading, sin heading) + wind
///   V' = (V_commanded - V) / lag, |roll'| <= roll_rate, sin(gamma) = climb rate / V
///
/// The roll is bounded so that the turn at cruise has `turn_radius`: tan(roll) =
/// airspeed^2 / (g turn_radius). The climb rate follows its command at once. Roll and
/// airspeed are solved exactly, heading and position by Simpson's rule over at most 0.1
/// s. So the step size changes positions by less than 1e-4 m in a minute (see the test).
/// Every command is bounded, one that is not a number counts as level flight at cruise;
/// where a climb would need more than the airspeed, the aircraft climbs straight up. So
/// the state stays finite.
/// Energy: the same power all the time, without a voltage. When the store is empty, the
/// battery or the motor (channel::kThrottle) has failed, it sinks by `glide_sink`.
/// Valid: no side-slip; the wind is constant within one step.
/// Reference: [Beard12] section 9.1 (kinematic guidance model).
class KinematicPlant final : public Plant {
 public:
  explicit KinematicPlant(const KinematicOptions& options);

  FlightLimits limits() const override;
  Airframe airframe() const override { return SelfStabilised{}; }
  VehicleState start(const VehicleStart& start) const override;
  /// Takes a FlightCommand.
  void step(VehicleState& state, const Control& control, const Air& air,
            double dt) const override;
  /// Never touches the ground whole.
  Contact touch(VehicleState&, double, double) const override { return Contact::kCrash; }

 private:
  struct Point;
  bool draw_power(VehicleState& state, double dt) const;
  void short_step(Point& point, const FlightCommand& command, const Air& air,
                  double dt) const;

  KinematicOptions options_;
  double roll_limit_;  // [rad]
};

}  // namespace skein::asset
