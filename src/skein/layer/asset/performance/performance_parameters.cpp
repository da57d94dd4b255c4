// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/asset/performance/performance_parameters.h"

#include <fmt/format.h>

#include <cmath>

#include "skein/layer/asset/performance/performance_model.h"

namespace skein::asset {
namespace {

void check_numbers(ParameterCheck& check, const PerformanceParameters& p) {
  check.above("mass", p.mass, 0);
  check.above("wing_area", p.wing_area, 0);
  check.above("zero_lift_drag", p.zero_lift_drag, 0);
  check.above("induced_drag", p.induced_drag, 0);
  check.above("lift_max", p.lift_max, 0);
  check.at_least("stall_reserve", p.stall_reserve, 1);
  check.above("power", p.power, 0);
  check.within("power_lapse", p.power_lapse, 0, 2);
  check.within("cruise_power", p.cruise_power, 0, 1);
  check.within("idle_power", p.idle_power, 0, p.cruise_power);
  check.require(p.propeller_efficiency > 0 && p.propeller_efficiency <= 1,
                "propeller_efficiency", p.propeller_efficiency,
                "must be above 0 and at most 1");
  check.at_least("propeller_speed", p.propeller_speed, 0);
  if (p.electric) {
    check.part("battery", errors(p.battery));
    check.require(p.motor_efficiency > 0 && p.motor_efficiency <= 1, "motor_efficiency",
                  p.motor_efficiency, "must be above 0 and at most 1");
  } else {
    check.part("tank", errors(p.tank));
  }
  check.above("slowest", p.slowest, 0);
  check.at_least("cruise", p.cruise, p.slowest);
  check.at_least("fastest", p.fastest, p.cruise);
  check.within("bank_limit", p.bank_limit, 0.01, 1.4);
  check.above("roll_rate", p.roll_rate, 0);
  check.above("acceleration", p.acceleration, 0);
  check.above("airspeed_lag", p.airspeed_lag, 0);
  check.above("climb_rate", p.climb_rate, 0);
  check.above("sink_rate", p.sink_rate, 0);
}

// Rules between numbers that are possible one by one.
void check_flight(ParameterCheck& check, const PerformanceParameters& p) {
  const PerformanceModel model(p);
  const double mass = model.mass(1);
  const double min = p.stall_reserve * model.stall_speed(mass, kSeaLevel);
  check.require(
      p.slowest > min, "slowest", p.slowest,
      fmt::format("must be above {:.4g}, the stall speed with its reserve", min));
  const double drag = model.drag(p.cruise, mass * kGravity, kSeaLevel);
  const double thrust = model.thrust(p.cruise_power * p.power, p.cruise);
  check.require(thrust > drag, "cruise", p.cruise,
                fmt::format("must be a speed that can be held: its drag is {:.4g} N, the "
                            "thrust {:.4g} N",
                            drag, thrust));
}

}  // namespace

std::vector<ParameterError> number_errors(const PerformanceParameters& parameters) {
  return found_by(parameters, check_numbers);
}

std::vector<ParameterError> errors(const PerformanceParameters& parameters) {
  return found_by(parameters, check_numbers, check_flight);
}

}  // namespace skein::asset
