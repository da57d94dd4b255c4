// SPDX-License-Identifier: Apache-2.0
// The keys of a multirotor in aircraft files.
#include "skein/assemble/aircraft/aircraft_fields.h"

namespace skein::assemble {
namespace {

using scenario::Fields;
using scenario::Range;

Fields<RotorFile> rotor_fields() {
  using T = RotorFile;
  constexpr Range kArm{.at_least = -100, .at_most = 100};
  return Fields<T>()
      .number("forward_m", &T::forward, "Of the centre of gravity.", kArm)
      .required()
      .number("right_m", &T::right, "Of the centre of gravity.", kArm)
      .required()
      .word("yaws", &T::spin,
            "Where its drag torque turns the airframe, seen from above.",
            {{"clockwise", T::Spin::kClockwise,
              "to the right; the rotor turns the opposite way"},
             {"counterclockwise", T::Spin::kCounterclockwise,
              "to the left; the rotor turns the opposite way"}})
      .required();
}

}  // namespace

MultirotorFile MultirotorFile::of(const asset::MultirotorParameters& multirotor) {
  MultirotorFile file;
  file.multirotor = multirotor;
  for (const RotorPlace& rotor : multirotor.rotors)
    file.rotors.push_back({rotor.position.x(), rotor.position.y(),
                           rotor.spin > 0 ? RotorFile::Spin::kClockwise
                                          : RotorFile::Spin::kCounterclockwise});
  file.battery = BatteryFile::of(multirotor.battery);
  return file;
}

asset::MultirotorParameters MultirotorFile::parameters() const {
  asset::MultirotorParameters all = multirotor;
  all.rotors.clear();
  for (const RotorFile& rotor : rotors)
    all.rotors.push_back({{rotor.forward, rotor.right},
                          rotor.spin == RotorFile::Spin::kClockwise ? 1.0 : -1.0});
  all.battery = battery.parameters();
  return all;
}

Fields<MultirotorFile> multirotor_fields() {
  using T = MultirotorFile;
  constexpr Range kSmall{.above = 0, .at_most = 1};
  constexpr Range kDrag{.at_least = 0, .at_most = 1000};
  constexpr Range kSpeed{.above = 0, .at_most = 1000};
  const auto in = [](auto member) {
    return [member](T & t) -> auto& {
      return t.multirotor.*member;
    };
  };
  using M = asset::MultirotorParameters;
  Fields<T> fields;
  fields
      .number("mass_kg", in(&M::mass), "Ready for flight.", {.above = 0, .at_most = 1e6})
      .required()
      .object("inertia", in(&M::inertia), inertia_fields(),
              "About the centre of gravity.")
      .required()
      .object("rotors", &T::rotors, rotor_fields(),
              "All equal, in one plane; channel k of the autopilot drives rotor k.")
      .required()
      .items({4, Actuators::kMaxChannels})
      .number("thrust_factor_ns2", in(&M::thrust_factor), "Thrust over speed squared.",
              kSmall)
      .required()
      .number("torque_factor_nms2", in(&M::torque_factor),
              "Drag torque over speed squared.", kSmall)
      .required()
      .number("rotor_radius_m", in(&M::rotor_radius), "Of the propellers.",
              {.above = 0, .at_most = 100})
      .required()
      .number("rotor_inertia_kgm2", in(&M::rotor_inertia),
              "Of one rotor with what turns of its motor.",
              {.at_least = 0, .at_most = 100})
      .required()
      .number("fastest_rotor_rad_per_s", in(&M::fastest_rotor), "Speed at full throttle.",
              {.above = 0, .at_most = 1e5})
      .required()
      .duration_s("motor_lag_s", in(&M::motor_lag),
                  "Time constant of the rotor's speed. Slower rotors than that cannot "
                  "balance the airframe.",
                  {.above = 0, .at_most = 0.5})
      .number("rotor_drag_ns2_per_m", in(&M::rotor_drag),
              "Force over rotor speed and air speed in the rotor's plane, of one rotor.",
              kDrag)
      .number("axial_drag_ns2_per_m", in(&M::axial_drag),
              "Thrust lost when climbing over rotor speed and climb rate, of one rotor.",
              kDrag)
      .number(
          "drag_area_forward_m2",
          [](T & t) -> auto& { return t.multirotor.drag_area.x(); },
          "Drag coefficient times area of the body, seen from the front.", kDrag)
      .number(
          "drag_area_right_m2", [](T & t) -> auto& { return t.multirotor.drag_area.y(); },
          "From the side.", kDrag)
      .number(
          "drag_area_down_m2", [](T & t) -> auto& { return t.multirotor.drag_area.z(); },
          "From above.", kDrag)
      .number("turn_drag_nms2", in(&M::turn_drag),
              "Moment of the body over turn rate squared.", kDrag)
      .number("efficiency", in(&M::efficiency), "Of motor and speed controller.",
              {.above = 0, .at_most = 1})
      .number("induced_factor", in(&M::induced_factor),
              "Induced power over that of an ideal disc.", {.at_least = 1, .at_most = 10})
      .number("standing_power_w", in(&M::standing_power), "Electronics.",
              {.at_least = 0, .at_most = 1e5})
      .object("battery", &T::battery, battery_fields(), "What feeds it.")
      .required()
      .object("ground", in(&M::ground), ground_fields(),
              "What it stands on, and what breaks it.")
      .angle_deg("tilt_limit_deg", in(&M::tilt_limit), "Largest that it is flown with.",
                 {.above = 0, .below = 90})
      .number("cruise_mps", in(&M::cruise), "Horizontal airspeed.", kSpeed)
      .required()
      .number("fastest_mps", in(&M::fastest), "Horizontal airspeed.", kSpeed)
      .required()
      .number("climb_rate_mps", in(&M::climb_rate), "Largest that it is flown with.",
              kSpeed)
      .required()
      .number("sink_rate_mps", in(&M::sink_rate), "Largest that it is flown with.",
              kSpeed)
      .required();
  fields.rules([keys = fields.description()](const T& file) {
    return at_file_keys(*keys, errors(file.parameters()));
  });
  return fields;
}

}  // namespace skein::assemble
