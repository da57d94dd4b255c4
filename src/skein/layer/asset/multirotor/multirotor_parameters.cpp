// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/asset/multirotor/multirotor_parameters.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "skein/base/math.h"
#include "skein/layer/asset/multirotor/momentum.h"
#include "skein/layer/asset/multirotor/rotor_set.h"

namespace skein::asset {
namespace {

void check_numbers(ParameterCheck& check, const MultirotorParameters& p) {
  check.above("mass", p.mass, 0);
  check.inertia("inertia", p.inertia);
  check.within("rotors", static_cast<double>(p.rotors.size()), 4,
               Actuators::kMaxChannels);
  for (std::size_t i = 0; i < p.rotors.size(); ++i) {
    const RotorPlace& rotor = p.rotors[i];
    check.require(rotor.position.allFinite(), fmt::format("rotors[{}].position", i),
                  rotor.position.norm(), "must be finite");
    check.require(std::abs(rotor.spin) == 1, fmt::format("rotors[{}].spin", i),
                  rotor.spin, "must be 1 or -1");
  }
  check.above("thrust_factor", p.thrust_factor, 0);
  check.above("torque_factor", p.torque_factor, 0);
  check.above("rotor_radius", p.rotor_radius, 0);
  check.at_least("rotor_inertia", p.rotor_inertia, 0);
  check.above("fastest_rotor", p.fastest_rotor, 0);
  check.above("motor_lag", p.motor_lag, 0);
  check.at_least("rotor_drag", p.rotor_drag, 0);
  check.at_least("axial_drag", p.axial_drag, 0);
  for (int i = 0; i < 3; ++i)
    check.at_least(fmt::format("drag_area[{}]", i), p.drag_area[i], 0);
  check.at_least("turn_drag", p.turn_drag, 0);
  check.require(p.efficiency > 0 && p.efficiency <= 1, "efficiency", p.efficiency,
                "must be above 0 and at most 1");
  check.at_least("induced_factor", p.induced_factor, 1);
  check.at_least("standing_power", p.standing_power, 0);
  check.part("battery", errors(p.battery));
  check.part("ground", errors(p.ground));
  check.within("tilt_limit", p.tilt_limit, 0.01, 1.4);
  check.above("cruise", p.cruise, 0);
  check.at_least("fastest", p.fastest, p.cruise);
  check.above("climb_rate", p.climb_rate, 0);
  check.above("sink_rate", p.sink_rate, 0);
}

// Rules between numbers that are possible one by one.
void check_flight(ParameterCheck& check, const MultirotorParameters& p) {
  const double weight = p.mass * kGravity;
  check.require(profile_torque_factor(p) > 0, "torque_factor", p.torque_factor,
                fmt::format("must be above {:.4g}, what the induced flow alone takes",
                            p.torque_factor - profile_torque_factor(p)));
  const RotorSet rotors(p.rotors);
  check.require(rotors.controllable(), "rotors", static_cast<double>(p.rotors.size()),
                "must be able to turn the airframe about all its axes one by one");
  if (!rotors.controllable()) return;

  const double max = p.thrust_factor * p.fastest_rotor * p.fastest_rotor;
  const auto hover =
      rotors.thrusts(weight, Vec3::Zero(), p.torque_factor / p.thrust_factor);
  const auto end = hover.begin() + static_cast<std::ptrdiff_t>(rotors.size());
  check.require(*std::min_element(hover.begin(), end) > 0, "rotors",
                static_cast<double>(p.rotors.size()),
                "must all push up in hover: the centre of gravity must be among them");
  const double loaded = *std::max_element(hover.begin(), end);
  check.require(loaded < max, "fastest_rotor", p.fastest_rotor,
                fmt::format("must be above {:.4g}, which hovering takes",
                            std::sqrt(std::max(0.0, loaded) / p.thrust_factor)));

  double speeds = 0;
  for (std::size_t i = 0; i < rotors.size(); ++i)
    speeds += std::sqrt(std::max(0.0, hover[i]) / p.thrust_factor);
  const double drag = p.rotor_drag * speeds * p.fastest +
                      0.5 * kRotorDensity * p.drag_area.x() * p.fastest * p.fastest;
  check.require(
      drag < weight * math::tan(p.tilt_limit), "fastest", p.fastest,
      fmt::format("must be a speed whose drag, here {:.4g} N, can be held within "
                  "tilt_limit",
                  drag));
}

}  // namespace

std::vector<ParameterError> number_errors(const MultirotorParameters& parameters) {
  return found_by(parameters, check_numbers);
}

std::vector<ParameterError> errors(const MultirotorParameters& parameters) {
  return found_by(parameters, check_numbers, check_flight);
}

}  // namespace skein::asset
