// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/layer/asset/fixed_wing/parameters.h"

namespace skein::asset {

/// The small UAV with the published Aerosonde coefficients: docs/fixed-wing.md, table 1.
inline FixedWingParameters aerosonde() {
  FixedWingParameters p;
  p.mass = 11;
  p.inertia = {.xx = 0.8244, .yy = 1.135, .zz = 1.759, .xz = 0.1204};
  p.geometry = {.area = 0.55, .span = 2.8956, .chord = 0.18994};
  p.aero = {.CL0 = 0.23,
            .CLa = 5.61,
            .CLq = 7.95,
            .CLde = 0.13,
            .CD0 = 0.043,
            .K = 0.02320027706739877,
            .Cm0 = 0.0135,
            .Cma = -2.74,
            .Cmq = -38.21,
            .Cmde = -0.99,
            .CY0 = 0,
            .CYb = -0.98,
            .CYp = 0,
            .CYr = 0,
            .CYda = 0.075,
            .CYdr = 0.19,
            .Cl0 = 0,
            .Clb = -0.13,
            .Clp = -0.51,
            .Clr = 0.25,
            .Clda = 0.17,
            .Cldr = 0.0024,
            .Cn0 = 0,
            .Cnb = 0.073,
            .Cnp = 0.069,
            .Cnr = -0.095,
            .Cnda = -0.011,
            .Cndr = -0.069};
  p.stall = Stall{.alpha = 0.47, .sharpness = 50};
  ElectricMotor motor{.diameter = 0.508,
                      .CT0 = 0.09357,
                      .CT1 = -0.06044,
                      .CT2 = -0.1079,
                      .CQ0 = 0.005230,
                      .CQ1 = 0.004970,
                      .CQ2 = -0.01664,
                      .K = 0.0658574,
                      .resistance = 0.042,
                      .no_load_current = 1.5,
                      .lag = 0.15};
  motor.battery.cells = 12;
  motor.battery.capacity_Ah = 12;
  motor.battery.resistance = 0.06;
  p.propulsion = motor;
  p.thrust_above = 0;
  p.servos = {.aileron_max = 0.436,
              .elevator_max = 0.524,
              .rudder_max = 0.436,
              .rate = 5,
              .lag = 0.04};
  p.envelope = {.cruise = 25,
                .slowest = 18,
                .fastest = 32,
                .bank_limit = 0.785,
                .pitch_up = 0.44,
                .pitch_down = -0.35};
  p.ground = {.sink_limit = 3,
              .speed_limit = 40,
              .tilt_limit = 0.6,
              .friction_along = 0.05,
              .friction_across = 0.6,
              .brake_friction = 0.3,
              .rest_pitch = 0.05,
              .levelling = 0.1,
              .nose_fall = 0.8,
              .yaw_grip = 3,
              .steering = 0.1};
  return p;
}

/// The foam glider of docs/fixed-wing.md, table 2: the defaults.
inline FixedWingParameters glider() {
  return {};
}

/// The light-sport aircraft of docs/fixed-wing.md, table 3.
inline FixedWingParameters light_sport() {
  FixedWingParameters p;
  p.mass = 580;
  p.inertia = {.xx = 670, .yy = 904, .zz = 1268, .xz = 40};
  p.geometry = {.area = 11.5, .span = 8.6, .chord = 1.37};
  p.aero = {.CL0 = 0.3,
            .CLa = 4.95,
            .CLq = 5,
            .CLde = 0.63,
            .CD0 = 0.027,
            .K = 0.062,
            .Cm0 = 0.005,
            .Cma = -0.65,
            .Cmq = -12,
            .Cmde = -1.85,
            .CY0 = 0,
            .CYb = -0.4,
            .CYp = 0,
            .CYr = 0.226,
            .CYda = 0,
            .CYdr = 0.15,
            .Cl0 = 0,
            .Clb = -0.095,
            .Clp = -0.46,
            .Clr = 0.1,
            .Clda = 0.17,
            .Cldr = 0.008,
            .Cn0 = 0,
            .Cnb = 0.075,
            .Cnp = -0.04,
            .Cnr = -0.112,
            .Cnda = -0.008,
            .Cndr = -0.068};
  p.stall = Stall{.alpha = 0.3, .sharpness = 50};
  p.propulsion = PistonEngine{.power_max = 73.5e3,
                              .static_thrust = 2100,
                              .efficiency = 0.85,
                              .lag = 0.4,
                              .tank = {}};
  p.thrust_above = 0;
  p.servos = {.aileron_max = 0.349,
              .elevator_max = 0.262,
              .rudder_max = 0.436,
              .rate = 1,
              .lag = 0.1};
  p.envelope = {.cruise = 50,
                .slowest = 30,
                .fastest = 58,
                .bank_limit = 0.785,
                .pitch_up = 0.3,
                .pitch_down = -0.26};
  p.ground = {.sink_limit = 3,
              .speed_limit = 50,
              .tilt_limit = 0.5,
              .friction_along = 0.04,
              .friction_across = 0.6,
              .brake_friction = 0.35,
              .rest_pitch = 0.03,
              .levelling = 0.2,
              .nose_fall = 0.2,
              .yaw_grip = 0.5,
              .steering = 0.05};
  return p;
}

}  // namespace skein::asset
