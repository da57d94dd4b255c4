// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/asset/fixed_wing/parameters.h"

#include <fmt/format.h>

#include <cmath>

#include "skein/layer/asset/fixed_wing/trim.h"
#include "skein/model/atmosphere/atmosphere.h"

namespace skein::asset {
namespace {

void check_aero(ParameterCheck& check, const AeroCoefficients& c) {
  const std::pair<const char*, double> any[] = {
      {"CL0", c.CL0}, {"CLq", c.CLq},   {"CLde", c.CLde}, {"Cm0", c.Cm0},
      {"Cma", c.Cma}, {"CY0", c.CY0},   {"CYb", c.CYb},   {"CYp", c.CYp},
      {"CYr", c.CYr}, {"CYda", c.CYda}, {"CYdr", c.CYdr}, {"Cl0", c.Cl0},
      {"Clb", c.Clb}, {"Clr", c.Clr},   {"Cldr", c.Cldr}, {"Cn0", c.Cn0},
      {"Cnb", c.Cnb}, {"Cnp", c.Cnp},   {"Cnda", c.Cnda}, {"Cndr", c.Cndr}};
  for (const auto& [key, value] : any) check.within(key, value, -100, 100);
  check.within("CLa", c.CLa, 0.1, 20);
  check.within("CD0", c.CD0, 0, 10);
  check.within("K", c.K, 0, 10);
  check.within("CDq", c.CDq, 0, 100);
  check.within("CDde", c.CDde, 0, 100);
  // Without damping, or with controls that do nothing or work backwards, nothing flies.
  check.within("Cmq", c.Cmq, -500, 0);
  check.within("Clp", c.Clp, -10, 0);
  check.within("Cnr", c.Cnr, -10, 0);
  check.within("Cmde", c.Cmde, -20, -1e-3);
  check.within("Clda", c.Clda, 1e-4, 10);
}

void check_propulsion(ParameterCheck& check, const Propulsion& propulsion) {
  if (const auto* motor = std::get_if<ElectricMotor>(&propulsion)) {
    check.above("diameter", motor->diameter, 0);
    check.above("CT0", motor->CT0, 0);
    check.at_least("CQ0", motor->CQ0, 1e-9);
    check.require(true, "CT1", motor->CT1, "");
    check.require(true, "CT2", motor->CT2, "");
    check.require(true, "CQ1", motor->CQ1, "");
    check.require(true, "CQ2", motor->CQ2, "");
    check.above("K", motor->K, 0);
    check.above("resistance", motor->resistance, 0);
    check.at_least("no_load_current", motor->no_load_current, 0);
    check.at_least("lag", motor->lag, 1e-3);
    check.part("battery", errors(motor->battery));
  } else if (const auto* piston = std::get_if<PistonEngine>(&propulsion)) {
    check.above("power_max", piston->power_max, 0);
    check.above("static_thrust", piston->static_thrust, 0);
    check.within("efficiency", piston->efficiency, 0.01, 1);
    check.at_least("lag", piston->lag, 1e-3);
    check.part("tank", errors(piston->tank));
  }
}

void check_servos(ParameterCheck& check, const Servos& s) {
  check.within("aileron_max", s.aileron_max, 0.01, 1.5);
  check.within("elevator_max", s.elevator_max, 0.01, 1.5);
  check.within("rudder_max", s.rudder_max, 0, 1.5);
  check.within("rate", s.rate, 0.1, 1000);
  check.within("lag", s.lag, 1e-3, 1);
}

void check_envelope(ParameterCheck& check, const Envelope& e) {
  check.above("slowest", e.slowest, 0);
  check.require(e.cruise >= e.slowest, "cruise", e.cruise,
                fmt::format("must be at least the slowest airspeed, {}", e.slowest));
  check.require(e.fastest >= e.cruise, "fastest", e.fastest,
                fmt::format("must be at least the cruise airspeed, {}", e.cruise));
  check.within("bank_limit", e.bank_limit, 0.05, 1.4);
  check.within("pitch_up", e.pitch_up, 0.01, 1.5);
  check.within("pitch_down", e.pitch_down, -1.5, -0.01);
}

// What only flying shows; the numbers by themselves are in order.
void check_flight(ParameterCheck& check, const FixedWingParameters& p) {
  const FixedWingModel model(p);
  const double max = model.aero.peak().lift_coefficient;
  const double stall = std::sqrt(2 * p.mass * kGravity /
                                 (model::kSeaLevelDensity * p.geometry.area * max));
  check.require(p.envelope.slowest > stall, "envelope.slowest", p.envelope.slowest,
                fmt::format("must be above the stall at {:.1f} m/s", stall));
  if (p.envelope.slowest <= stall) return;
  const std::pair<const char*, double> speeds[] = {
      {"envelope.slowest", p.envelope.slowest},
      {"envelope.cruise", p.envelope.cruise},
      {"envelope.fastest", p.envelope.fastest}};
  for (const auto& [key, airspeed] : speeds) {
    const TrimResult level = find_trim(model, {airspeed});
    // Without an engine nobody flies level.
    const bool glides =
        !model.engine.exists() && level.outcome == TrimOutcome::kThrustTooSmall;
    check.require(level.found() || glides, key, airspeed,
                  "cannot be flown level: " + reason(model, level));
  }
}

void check_numbers(ParameterCheck& check, const FixedWingParameters& p) {
  check.above("mass", p.mass, 0);
  check.inertia("inertia", p.inertia);
  check.above("geometry.area", p.geometry.area, 0);
  check.above("geometry.span", p.geometry.span, 0);
  check.above("geometry.chord", p.geometry.chord, 0);
  const double box = p.geometry.span * p.geometry.chord;
  check.require(
      box > 0.4 * p.geometry.area && box < 2.5 * p.geometry.area, "geometry.chord",
      p.geometry.chord,
      "times the span must be the wing's area, or within a factor of 2.5 of it");
  check.part("aero", found_by(p.aero, check_aero));
  if (p.stall) {
    check.within("stall.alpha", p.stall->alpha, 0.05, 1);
    check.within("stall.sharpness", p.stall->sharpness, 5, 200);
  }
  check.part("propulsion", found_by(p.propulsion, check_propulsion));
  check.within("thrust_above", p.thrust_above, -10, 10);
  check.part("servos", found_by(p.servos, check_servos));
  check.part("envelope", found_by(p.envelope, check_envelope));
  check.part("ground", errors(p.ground));
  if (p.hand_launch) check.part("hand_launch", errors(*p.hand_launch));
}

}  // namespace

std::vector<ParameterError> errors(const AeroCoefficients& coefficients) {
  return found_by(coefficients, check_aero);
}

std::vector<ParameterError> errors(const Servos& servos) {
  return found_by(servos, check_servos);
}

std::vector<ParameterError> errors(const Envelope& envelope) {
  return found_by(envelope, check_envelope);
}

std::vector<ParameterError> errors(const FixedWingParameters& p) {
  return found_by(p, check_numbers, check_flight);
}

}  // namespace skein::asset
