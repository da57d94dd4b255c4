// SPDX-License-Identifier: Apache-2.0
// The keys of a fixed wing in aircraft files.
#include <utility>
#include <variant>

#include "skein/assemble/aircraft/aircraft_fields.h"

namespace skein::assemble {
namespace {

using asset::AeroCoefficients;
using scenario::Fields;
using scenario::Range;

constexpr Range kCoefficient{.at_least = -1000, .at_most = 1000};
constexpr Range kSpeed{.above = 0, .at_most = 1000};

Fields<asset::WingGeometry> geometry_fields() {
  using T = asset::WingGeometry;
  constexpr Range kLength{.above = 0, .at_most = 1000};
  return Fields<T>()
      .number("area_m2", &T::area, "Of the wing.", {.above = 0, .at_most = 1e5})
      .required()
      .number("span_m", &T::span, "Of the wing.", kLength)
      .required()
      .number("chord_m", &T::chord, "Mean aerodynamic.", kLength)
      .required();
}

struct Coefficient {
  const char* key;
  double AeroCoefficients::*member;
  const char* help;
  bool required = false;
  Range range = kCoefficient;
};

// A part's errors are reported even where others cannot be read.
template <class Part>
Fields<Part> with_faults(Fields<Part> fields) {
  fields.rules([keys = fields.description()](const Part& part) {
    return at_file_keys(*keys, asset::errors(part));
  });
  return fields;
}

Fields<AeroCoefficients> aero_fields() {
  using T = AeroCoefficients;
  constexpr Range kNotNegative{.at_least = 0, .at_most = 1000};
  const Coefficient all[] = {
      {"CL0", &T::CL0, "Lift at angle of attack 0.", true},
      {"CLa", &T::CLa, "Lift per angle of attack.", true, {.above = 0, .at_most = 1000}},
      {"CLq", &T::CLq, "Lift per pitch rate."},
      {"CLde", &T::CLde, "Lift per elevator."},
      {"CD0", &T::CD0, "Drag without lift.", true, {.above = 0, .at_most = 1000}},
      {"K", &T::K, "Drag per square of CL0 + CLa a.", true, kNotNegative},
      {"CDq", &T::CDq, "Drag per size of the pitch rate.", false, kNotNegative},
      {"CDde", &T::CDde, "Drag per size of the elevator's deflection.", false,
       kNotNegative},
      {"Cm0", &T::Cm0, "Pitching moment at angle of attack 0.", true},
      {"Cma", &T::Cma, "Pitching moment per angle of attack.", true},
      {"Cmq", &T::Cmq, "Per pitch rate.", true},
      {"Cmde", &T::Cmde, "Per elevator.", true, {.below = 0}},
      {"CY0", &T::CY0, "Side force without side-slip."},
      {"CYb", &T::CYb, "Side force per side-slip.", true},
      {"CYp", &T::CYp, "Per roll rate."},
      {"CYr", &T::CYr, "Per yaw rate."},
      {"CYda", &T::CYda, "Per aileron."},
      {"CYdr", &T::CYdr, "Per rudder."},
      {"Cl0", &T::Cl0, "Rolling moment without side-slip."},
      {"Clb", &T::Clb, "Rolling moment per side-slip.", true},
      {"Clp", &T::Clp, "Per roll rate.", true},
      {"Clr", &T::Clr, "Per yaw rate.", true},
      {"Clda", &T::Clda, "Per aileron.", true, {.above = 0}},
      {"Cldr", &T::Cldr, "Per rudder."},
      {"Cn0", &T::Cn0, "Yawing moment without side-slip."},
      {"Cnb", &T::Cnb, "Yawing moment per side-slip.", true},
      {"Cnp", &T::Cnp, "Per roll rate."},
      {"Cnr", &T::Cnr, "Per yaw rate.", true},
      {"Cnda", &T::Cnda, "Per aileron."},
      {"Cndr", &T::Cndr, "Per rudder."},
  };
  Fields<T> fields;
  for (const Coefficient& each : all) {
    fields.number(each.key, each.member, each.help, each.range);
    if (each.required) fields.required();
  }
  return with_faults(std::move(fields));
}

Fields<asset::Stall> stall_fields() {
  using T = asset::Stall;
  return Fields<T>()
      .angle_deg("alpha_deg", &T::alpha,
                 "Angle of attack where half of the linear laws is gone over to a flat "
                 "plate.",
                 {.above = 0, .at_most = 60})
      .number("sharpness_per_rad", &T::sharpness, "How fast they go over.",
              {.above = 0, .at_most = 1000});
}

Fields<ElectricMotorFile> electric_motor_fields() {
  using T = ElectricMotorFile;
  return Fields<T>()
      .number("diameter_m", [](T & t) -> auto& { return t.motor.diameter; },
              "Of the propeller.", {.above = 0, .at_most = 20})
      .required()
      .number("CT0", [](T & t) -> auto& { return t.motor.CT0; },
              "Thrust coefficient, standing.", {.above = 0, .at_most = 10})
      .required()
      .number(
          "CT1", [](T & t) -> auto& { return t.motor.CT1; }, "Per advance ratio.",
          kCoefficient)
      .required()
      .number(
          "CT2", [](T & t) -> auto& { return t.motor.CT2; }, "Per advance ratio squared.",
          kCoefficient)
      .required()
      .number("CQ0", [](T & t) -> auto& { return t.motor.CQ0; },
              "Torque coefficient, standing.", {.above = 0, .at_most = 10})
      .required()
      .number(
          "CQ1", [](T & t) -> auto& { return t.motor.CQ1; }, "Per advance ratio.",
          kCoefficient)
      .required()
      .number(
          "CQ2", [](T & t) -> auto& { return t.motor.CQ2; }, "Per advance ratio squared.",
          kCoefficient)
      .required()
      .number("k_nm_per_a", [](T & t) -> auto& { return t.motor.K; },
              "Torque per current; also voltage per speed [V s/rad].",
              {.above = 0, .at_most = 100})
      .required()
      .number("resistance_ohm", [](T & t) -> auto& { return t.motor.resistance; },
              "Of motor and speed controller.", {.above = 0, .at_most = 100})
      .required()
      .number("no_load_current_a", [](T & t) -> auto& { return t.motor.no_load_current; },
              "Current that gives no torque.", {.at_least = 0, .at_most = 1000})
      .required()
      .duration_s(
          "lag_s", [](T & t) -> auto& { return t.motor.lag; },
          "Time constant of the rotor's speed.")
      .object("battery", &T::battery, battery_fields(), "What feeds it.")
      .required();
}

Fields<asset::PistonEngine> piston_engine_fields() {
  using T = asset::PistonEngine;
  return Fields<T>()
      .number("power_max_w", &T::power_max, "At sea level.", {.above = 0, .at_most = 1e7})
      .required()
      .number("static_thrust_n", &T::static_thrust, "Standing, at full power.",
              {.above = 0, .at_most = 1e6})
      .required()
      .number("efficiency", &T::efficiency, "Of the propeller.",
              {.above = 0, .at_most = 1})
      .duration_s("lag_s", &T::lag, "Time constant of the power.")
      .object("tank", &T::tank, tank_fields(), "Its fuel.")
      .required();
}

Fields<asset::Servos> servo_fields() {
  using T = asset::Servos;
  constexpr Range kDeflection{.above = 0, .at_most = 90};
  return with_faults(
      Fields<T>()
          .angle_deg("aileron_max_deg", &T::aileron_max,
                     "Largest deflection, in both directions.", kDeflection)
          .required()
          .angle_deg("elevator_max_deg", &T::elevator_max,
                     "Largest deflection, in both directions.", kDeflection)
          .required()
          .angle_deg("rudder_max_deg", &T::rudder_max,
                     "Largest deflection, in both directions; 0: it has no rudder.",
                     {.at_least = 0, .at_most = 90})
          .required()
          .angle_deg("rate_deg_per_s", &T::rate, "Largest.", {.above = 0, .at_most = 1e5})
          .duration_s("lag_s", &T::lag, "Time constant."));
}

Fields<asset::Envelope> envelope_fields() {
  using T = asset::Envelope;
  return with_faults(Fields<T>()
                         .number("cruise_mps", &T::cruise, "Airspeed.", kSpeed)
                         .required()
                         .number("slowest_mps", &T::slowest,
                                 "Minimum airspeed to fly at: the stall with a reserve.",
                                 kSpeed)
                         .required()
                         .number("fastest_mps", &T::fastest, "Airspeed.", kSpeed)
                         .required()
                         .angle_deg("bank_limit_deg", &T::bank_limit, "Largest bank.",
                                    {.above = 0, .below = 90})
                         .angle_deg("pitch_up_deg", &T::pitch_up, "Largest pitch angle.",
                                    {.above = 0, .below = 90})
                         .angle_deg("pitch_down_deg", &T::pitch_down,
                                    "Minimum pitch angle.", {.above = -90, .below = 0}));
}

Fields<asset::HandLaunch> hand_launch_fields() {
  using T = asset::HandLaunch;
  return with_faults(
      Fields<T>()
          .number("speed_mps", &T::speed, "Over ground, as it leaves the hand.",
                  {.above = 0, .at_most = 100})
          .required()
          .angle_deg("pitch_deg", &T::pitch, "Of nose and throw, above the horizon.",
                     {.at_least = 0, .at_most = 60})
          .number("height_m", &T::height, "Of the hand that holds it, above ground.",
                  {.above = 0, .at_most = 100})
          .number("reach_m", &T::reach, "Way over which it is pushed.",
                  {.above = 0, .at_most = 100}));
}

}  // namespace

FixedWingFile::FixedWingFile() {
  for (double AeroCoefficients::*each :
       {&AeroCoefficients::CL0,  &AeroCoefficients::CLa,  &AeroCoefficients::CLq,
        &AeroCoefficients::CLde, &AeroCoefficients::CD0,  &AeroCoefficients::K,
        &AeroCoefficients::Cm0,  &AeroCoefficients::Cma,  &AeroCoefficients::Cmq,
        &AeroCoefficients::Cmde, &AeroCoefficients::CYb,  &AeroCoefficients::CYr,
        &AeroCoefficients::CYdr, &AeroCoefficients::Clb,  &AeroCoefficients::Clp,
        &AeroCoefficients::Clr,  &AeroCoefficients::Clda, &AeroCoefficients::Cldr,
        &AeroCoefficients::Cnb,  &AeroCoefficients::Cnp,  &AeroCoefficients::Cnr,
        &AeroCoefficients::Cnda, &AeroCoefficients::Cndr})
    wing.aero.*each = 0;
  wing.stall.reset();
  wing.propulsion = std::monostate{};
  wing.thrust_above = 0;
}

FixedWingFile FixedWingFile::of(const asset::FixedWingParameters& wing) {
  FixedWingFile file;
  file.wing = wing;
  if (const auto* motor = std::get_if<asset::ElectricMotor>(&wing.propulsion))
    file.electric_motor = {*motor, BatteryFile::of(motor->battery)};
  if (const auto* engine = std::get_if<asset::PistonEngine>(&wing.propulsion))
    file.piston_engine = *engine;
  return file;
}

asset::FixedWingParameters FixedWingFile::parameters() const {
  asset::FixedWingParameters all = wing;
  if (electric_motor) {
    asset::ElectricMotor motor = electric_motor->motor;
    motor.battery = electric_motor->battery.parameters();
    all.propulsion = motor;
  } else if (piston_engine) {
    all.propulsion = *piston_engine;
  }
  return all;
}

Fields<FixedWingFile> fixed_wing_fields() {
  using T = FixedWingFile;
  Fields<T> fields;
  fields
      .number("mass_kg", [](T & t) -> auto& { return t.wing.mass; }, "Ready for flight.",
              {.above = 0, .at_most = 1e6})
      .required()
      .object(
          "inertia", [](T & t) -> auto& { return t.wing.inertia; }, inertia_fields(),
          "About the centre of gravity.")
      .required()
      .object(
          "geometry", [](T & t) -> auto& { return t.wing.geometry; }, geometry_fields(),
          "Lengths that make coefficients dimensionless.")
      .required()
      .object(
          "aero", [](T & t) -> auto& { return t.wing.aero; }, aero_fields(),
          "Coefficients and their derivatives, per radian; those not given are 0.")
      .required()
      .object(
          "stall", [](T & t) -> auto& { return t.wing.stall; }, stall_fields(),
          "How the wing stalls; null: it does not.")
      .object("electric_motor", &T::electric_motor, electric_motor_fields(),
              "Motor with a fixed propeller and its battery.")
      .object("piston_engine", &T::piston_engine, piston_engine_fields(),
              "Engine with a constant-speed propeller. With neither motor it glides.")
      .number("thrust_above_m", [](T & t) -> auto& { return t.wing.thrust_above; },
              "How far the line of thrust runs above the centre of gravity.",
              {.at_least = -100, .at_most = 100})
      .object(
          "servos", [](T & t) -> auto& { return t.wing.servos; }, servo_fields(),
          "What moves the surfaces.")
      .required()
      .object(
          "envelope", [](T & t) -> auto& { return t.wing.envelope; }, envelope_fields(),
          "Where it may be flown.")
      .required()
      .object(
          "ground", [](T & t) -> auto& { return t.wing.ground; }, ground_fields(),
          "What it stands on, and what breaks it.")
      .object(
          "hand_launch", [](T & t) -> auto& { return t.wing.hand_launch; },
          hand_launch_fields(),
          "How a crew throws it into the wind, from a start on the ground; null: it "
          "rolls.")
      .rule("piston_engine", [](const T& file) -> std::string {
        return file.electric_motor && file.piston_engine
                   ? "stands beside electric_motor; give one of the two."
                   : "";
      });
  fields.rules([keys = fields.description()](const T& file) {
    std::vector<asset::ParameterError> found = errors(file.parameters());
    for (asset::ParameterError& error : found) {
      constexpr std::string_view kPropulsion = "propulsion.";
      if (error.key.starts_with(kPropulsion))
        error.key = (file.electric_motor ? "electric_motor." : "piston_engine.") +
                    error.key.substr(kPropulsion.size());
    }
    return at_file_keys(*keys, found);
  });
  return fields;
}

}  // namespace skein::assemble
