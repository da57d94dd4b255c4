// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/layer/asset/body/energy_source.h"
#include "skein/layer/asset/performance/performance_model.h"
#include "skein/role/plant.h"

namespace skein::asset {

/// A point mass in coordinated flight whose speed and height share one budget of energy.
///
///   (T - D) V = m g h' + m V V'                                       [BADA, Eq. 3.1-1]
///   D = q S (C_D0 + K C_L^2),  q S C_L = m g / cos(roll)
///   heading' = g tan(roll) / V,  |roll'| <= roll_rate,  p' = V (...) + wind
///
/// Its commands are climb rate and airspeed; the demanded V' is (commanded - V) /
/// airspeed_lag within `acceleration`. When the thrust that both take is more than there
/// is, climbing and accelerating are cut in the same proportion; when even level flight
/// at this speed takes more, it sinks at this speed, or slows down as commanded. When it
/// is less than idle thrust, sinking and slowing down are cut in the same way. So there
/// is a ceiling, and a glide with L/D, and neither comes from a limit of its own.
///
/// Level and descending flight uses at most `cruise_power`; climbs use all power from 1
/// m/s on, less in proportion below. Airspeed is kept `stall_reserve` above the stall at
/// the bank angle flown, and the bank below the one that would stall it at the airspeed.
/// Energy comes from the tank, or the battery; burnt fuel makes it lighter.
/// Bad commands are bounded as by KinematicPlant. The flight is integrated by RK4 in
/// steps of at most 0.1 s.
/// Faults: a dead motor (channel::kThrottle) gives no thrust, a stuck one keeps its
/// power; a dead or stuck aileron keeps the roll angle.
/// VehicleState::actuators[kThrottle] is the share of `power` in use. Valid: small path
/// angles (lift takes all the weight), no side-slip, air and mass constant within one
/// step; climb rate follows its command at once.
class PerformancePlant final : public Plant {
 public:
  /// The parameters must be without number_errors().
  explicit PerformancePlant(const PerformanceParameters& parameters);

  FlightLimits limits() const override;
  Airframe airframe() const override;
  VehicleState start(const VehicleStart& start) const override;
  /// Takes a FlightCommand.
  void step(VehicleState& state, const Control& control, const Air& air,
            double dt) const override;
  /// Never touches the ground whole.
  Contact touch(VehicleState&, double, double) const override { return Contact::kCrash; }

  const PerformanceModel& model() const { return model_; }

 private:
  struct Point;
  struct Rate;
  struct Phase;
  double min_density() const;
  double steepest_bank(double airspeed, double mass, double density) const;
  Rate rate(const Point& point, double roll, const Phase& phase) const;
  Point short_step(const Point& point, const Phase& phase, double roll, double roll_rate,
                   double dt) const;
  Phase phase_of(const VehicleState& state, double roll, const FlightCommand& command,
                 const Air& air) const;

  PerformanceParameters parameters_;
  PerformanceModel model_;
  EnergySource source_;
};

}  // namespace skein::asset
