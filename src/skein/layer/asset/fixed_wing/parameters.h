// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <variant>
#include <vector>

#include "skein/geo/vec.h"
#include "skein/layer/asset/body/battery.h"
#include "skein/layer/asset/body/fuel_tank.h"
#include "skein/layer/asset/body/ground_contact.h"
#include "skein/layer/asset/body/launch_crew.h"
#include "skein/layer/asset/body/parameter_error.h"
#include "skein/layer/asset/body/rigid_body.h"

namespace skein::asset {

// The defaults are those of the foam glider in docs/fixed-wing.md, table 2.

/// Lengths that make coefficients dimensionless.
struct WingGeometry {
  double area = 0.26;    ///< S [m^2]
  double span = 1.5;     ///< b [m]
  double chord = 0.173;  ///< mean aerodynamic, c [m]
};

/// Dimensionless derivatives, per radian. a = angle of attack, b = side-slip; p, q, r
/// stand for p b/(2 V), q c/(2 V), r b/(2 V); de, da, dr for the deflections with the
/// signs of data/vehicle/control.h.
struct AeroCoefficients {
  // Lift and drag. CD = CD0 + K (CL0 + CLa a)^2 + CDq |q| + CDde |de|.
  double CL0 = 0.28, CLa = 5.1, CLq = 5, CLde = 0.34;
  double CD0 = 0.045, K = 0.045, CDq = 0, CDde = 0;
  // Pitching moment.
  double Cm0 = 0.012, Cma = -0.7, Cmq = -16, Cmde = -1.2;
  // Side force.
  double CY0 = 0, CYb = -0.3, CYp = 0, CYr = 0.136, CYda = 0, CYdr = 0.1;
  // Rolling moment.
  double Cl0 = 0, Clb = -0.09, Clp = -0.5, Clr = 0.09, Clda = 0.19, Cldr = 0.002;
  // Yawing moment.
  double Cn0 = 0, Cnb = 0.05, Cnp = -0.03, Cnr = -0.06, Cnda = -0.01, Cndr = -0.041;
};

/// How the wing stalls: with s going from 0 to 1 around |a| = `alpha`,
///
///   s = 1 - 1/((1 + exp(M (a - alpha))) (1 + exp(-M (a + alpha))))
///
/// static lift, drag and pitching moment go over from the linear ones, (1 - s), to those
/// of a flat plate, s: CL = 2 sgn(a) sin^2(a) cos(a), CD = CD0 + 2 |sin(a)|^3,
/// Cm = Cma sin(a).
/// Reference: [Beard12] Eqs. (4.9), (4.10); drag and moment are the same plate's.
struct Stall {
  double alpha = 0.24;    ///< where half is gone over [rad]
  double sharpness = 50;  ///< M [1/rad]
};

/// Electric motor with a fixed propeller in steady state: the torques balance at the
/// rotor speed W that solves a quadratic, which is then reached with a lag.
///
///   J = 2 pi V/(W D),  CT = CT0 + CT1 J + CT2 J^2,  CQ = CQ0 + CQ1 J + CQ2 J^2
///   thrust = rho D^4/(4 pi^2) W^2 CT,  torque = rho D^5/(4 pi^2) W^2 CQ
///   torque = K (I - I0),  I = (U - K W)/R,  U = throttle times the battery's voltage
///
/// V is the air's velocity along the shaft. What the motor takes from the battery is U I.
/// Thrust and torque below 0 are cut off: the propeller folds or runs free, it does not
/// brake. The torque rolls the airframe to the left.
/// Reference: [Beard21] section 4.3.
struct ElectricMotor {
  double diameter = 0.16;  ///< D [m]
  double CT0 = 0.1, CT1 = -0.045, CT2 = -0.06;
  double CQ0 = 0.0098, CQ1 = 0.0022, CQ2 = -0.0085;
  double K = 0.00682;            ///< torque per current, = 1/KV [N m/A = V s/rad]
  double resistance = 0.12;      ///< R, with its speed controller [ohm]
  double no_load_current = 0.8;  ///< I0 [A]
  double lag = 0.08;             ///< time constant of the rotor speed [s]
  BatteryParameters battery{};
};

/// Piston engine (or any that gives power) with a constant-speed propeller.
///
///   power = throttle power_max f(rho),  f = 1.132 rho/rho0 - 0.132
///   thrust = efficiency power / sqrt(V^2 + V0^2),
///   V0 = efficiency power_max / static_thrust
///
/// So the thrust is static_thrust when standing and efficiency power/V when fast.
/// Reference: f: [Gagg34] for engines without charger.
struct PistonEngine {
  double power_max = 73.5e3;    ///< at sea level [W]
  double static_thrust = 2100;  ///< [N]
  double efficiency = 0.85;     ///< of the propeller
  double lag = 0.4;             ///< time constant of the power [s]
  FuelTankParameters tank{};
};

/// What drives the aircraft; monostate: nothing, it glides.
using Propulsion = std::variant<std::monostate, ElectricMotor, PistonEngine>;

/// What moves the surfaces: a first-order lag with a largest rate.
struct Servos {
  double aileron_max = 0.349;   ///< largest deflection, in both directions [rad]
  double elevator_max = 0.349;  ///< [rad]
  double rudder_max = 0.436;    ///< [rad]; 0: it has none
  double rate = 6;              ///< largest [rad/s]
  double lag = 0.04;            ///< time constant [s]
};

/// Where it may be flown.
struct Envelope {
  double cruise = 15;        ///< airspeed [m/s]
  double slowest = 11;       ///< minimum airspeed to fly at: stall with a reserve [m/s]
  double fastest = 18;       ///< [m/s]
  double bank_limit = 0.7;   ///< [rad]
  double pitch_up = 0.45;    ///< largest pitch angle [rad]
  double pitch_down = -0.4;  ///< minimum pitch angle, negative [rad]
};

/// A fixed-wing aircraft.
struct FixedWingParameters {
  double mass = 0.9;  ///< [kg]
  Inertia inertia{.xx = 0.028, .yy = 0.026, .zz = 0.052, .xz = 0.001};
  WingGeometry geometry;
  AeroCoefficients aero;
  std::optional<Stall> stall = Stall{};  ///< none: the linear laws hold everywhere
  Propulsion propulsion = ElectricMotor{};
  /// How far the line of thrust runs above the centre of gravity [m].
  double thrust_above = 0.06;
  Servos servos;
  Envelope envelope;
  GroundContactParameters ground{.sink_limit = 3,
                                 .speed_limit = 25,
                                 .tilt_limit = 0.7,
                                 .friction_along = 0.25,
                                 .friction_across = 0.5,
                                 .rest_pitch = 0.08};
  std::optional<HandLaunch> hand_launch;  ///< none: it rolls
};

/// What must hold for these; keys are member names. Beside the ranges of single numbers:
/// the slowest airspeed is above the stall, the airspeeds are in order, and the aircraft
/// can fly level at each of the three with its surfaces and its motor.
std::vector<ParameterError> errors(const FixedWingParameters& parameters);
/// Those of single parts, by themselves.
std::vector<ParameterError> errors(const AeroCoefficients& coefficients);
std::vector<ParameterError> errors(const Servos& servos);
std::vector<ParameterError> errors(const Envelope& envelope);

}  // namespace skein::asset
