// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "skein/data/vehicle/air.h"
#include "skein/layer/asset/performance/performance_parameters.h"

namespace skein::asset {

/// Density at which engine numbers hold [kg/m^3].
inline constexpr double kSeaLevel = 1.225;

/// Forces and powers that follow from the parameters of an aeroplane.
class PerformanceModel {
 public:
  explicit PerformanceModel(const PerformanceParameters& parameters)
      : parameters_(parameters) {}

  /// With this share of the fuel [kg].
  double mass(double charge) const {
    const PerformanceParameters& p = parameters_;
    return p.electric ? p.mass : p.mass + charge * p.tank.fuel;
  }

  /// Drag at a lift [N]: q S C_D0 + K lift^2 / (q S) [N].
  double drag(double airspeed, double lift, double density) const {
    const double qs = 0.5 * density * airspeed * airspeed * parameters_.wing_area;
    return qs * parameters_.zero_lift_drag + parameters_.induced_drag * lift * lift / qs;
  }

  /// Airspeed at which a lift of the weight needs the largest C_L [m/s]. At load factor n
  /// it is sqrt(n) times as much.
  double stall_speed(double mass, double density) const {
    return std::sqrt(2 * mass * kGravity /
                     (density * parameters_.wing_area * parameters_.lift_max));
  }

  /// Largest power at the shaft [W].
  double max_power(double density) const {
    const double part = 1 - parameters_.power_lapse * (1 - density / kSeaLevel);
    return part > 0 ? part * parameters_.power : 0;
  }

  /// Thrust of a shaft power [N], and the inverse [W].
  double thrust(double power, double airspeed) const {
    return parameters_.propeller_efficiency * power /
           (airspeed + parameters_.propeller_speed);
  }
  double power(double thrust, double airspeed) const {
    return thrust * (airspeed + parameters_.propeller_speed) /
           parameters_.propeller_efficiency;
  }

 private:
  PerformanceParameters parameters_;
};

}  // namespace skein::asset
