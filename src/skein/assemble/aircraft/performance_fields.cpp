// SPDX-License-Identifier: Apache-2.0
// The keys of the performance model in aircraft files.
#include "skein/assemble/aircraft/aircraft_fields.h"

namespace skein::assemble {

using scenario::Fields;
using scenario::Range;

asset::PerformanceParameters PerformanceFile::parameters() const {
  asset::PerformanceParameters all = performance;
  all.electric = battery.has_value();
  if (battery) all.battery = battery->parameters();
  if (tank) all.tank = *tank;
  return all;
}

PerformanceFile PerformanceFile::of(const asset::PerformanceParameters& performance) {
  PerformanceFile file;
  file.performance = performance;
  if (performance.electric)
    file.battery = BatteryFile::of(performance.battery);
  else
    file.tank = performance.tank;
  return file;
}

Fields<PerformanceFile> performance_fields() {
  using T = PerformanceFile;
  using P = asset::PerformanceParameters;
  constexpr Range kSpeed{.above = 0, .at_most = 1000};
  constexpr Range kShare{.at_least = 0, .at_most = 1};
  constexpr Range kCoefficient{.above = 0, .at_most = 100};
  const auto in = [](auto member) {
    return [member](T & t) -> auto& {
      return t.performance.*member;
    };
  };
  Fields<T> fields;
  fields
      .number("mass_kg", in(&P::mass), "Ready for flight, without fuel.",
              {.above = 0, .at_most = 1e6})
      .required()
      .number("wing_area_m2", in(&P::wing_area), "Of the wing.",
              {.above = 0, .at_most = 1e5})
      .required()
      .number("zero_lift_drag", in(&P::zero_lift_drag), "Drag coefficient without lift.",
              kCoefficient)
      .required()
      .number("induced_drag", in(&P::induced_drag),
              "Drag coefficient per square of the lift coefficient.", kCoefficient)
      .required()
      .number("lift_max", in(&P::lift_max), "Largest lift coefficient.", kCoefficient)
      .required()
      .number("stall_reserve", in(&P::stall_reserve),
              "Minimum airspeed over the stall speed, at any bank.",
              {.at_least = 1, .at_most = 10})
      .number("power_w", in(&P::power), "At the shaft, at sea level.",
              {.above = 0, .at_most = 1e8})
      .required()
      .number("power_lapse", in(&P::power_lapse),
              "Share of the power lost over share of the density lost: piston engines "
              "1.132, electric motors 0.",
              {.at_least = 0, .at_most = 2})
      .number("cruise_power", in(&P::cruise_power),
              "Share of the power at most used in level flight.", kShare)
      .number("idle_power", in(&P::idle_power), "Share of the power that pushes at idle.",
              kShare)
      .number("propeller_efficiency", in(&P::propeller_efficiency), "At great speed.",
              {.above = 0, .at_most = 1})
      .number("propeller_speed_mps", in(&P::propeller_speed),
              "Airspeed at which the propeller has half of that.",
              {.at_least = 0, .at_most = 1000})
      .object("tank", &T::tank, tank_fields(), "Its fuel, unless it flies on a battery.")
      .object("battery", &T::battery, battery_fields(), "What it flies on instead.")
      .number("motor_efficiency", in(&P::motor_efficiency),
              "Shaft power over battery power, with a battery.",
              {.above = 0, .at_most = 1})
      .number("cruise_mps", in(&P::cruise), "Airspeed.", kSpeed)
      .required()
      .number("slowest_mps", in(&P::slowest), "Airspeed.", kSpeed)
      .required()
      .number("fastest_mps", in(&P::fastest), "Airspeed.", kSpeed)
      .required()
      .angle_deg("bank_limit_deg", in(&P::bank_limit), "Largest bank.",
                 {.above = 0, .below = 90})
      .angle_deg("roll_rate_deg_per_s", in(&P::roll_rate), "Largest.",
                 {.above = 0, .at_most = 1e4})
      .number("acceleration_mps2", in(&P::acceleration),
              "Largest along the path, in both directions.",
              {.above = 0, .at_most = 1000})
      .duration_s("airspeed_lag_s", in(&P::airspeed_lag),
                  "Time constant of the airspeed.", {.above = 0})
      .number("climb_rate_mps", in(&P::climb_rate), "Maximum demanded.", kSpeed)
      .required()
      .number("sink_rate_mps", in(&P::sink_rate), "Maximum demanded.", kSpeed)
      .required()
      .rule("battery", [](const T& file) -> std::string {
        if (file.tank && file.battery) return "stands beside tank; give one of the two.";
        return file.tank || file.battery ? "" : "is missing, as is tank; give one.";
      });
  fields.rules([keys = fields.description()](const T& file) {
    return at_file_keys(*keys, errors(file.parameters()));
  });
  return fields;
}

}  // namespace skein::assemble
