// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "skein/layer/asset/fixed_wing/parameters.h"
#include "skein/layer/asset/multirotor/multirotor_parameters.h"
#include "skein/layer/asset/performance/performance_parameters.h"
#include "skein/scenario/fields.h"

// How the parameters of aircraft are written in files: one set of keys per struct. Where
// a struct of the asset layer holds what a file says in another form (a choice of motors,
// a table, a sense of rotation), a struct of the file's own stands between.

namespace skein::assemble {

/// A battery as files say it.
struct BatteryFile {
  asset::BatteryParameters battery;
  std::vector<double> open_circuit;  ///< 11 voltages; else the default curve counts

  static BatteryFile of(const asset::BatteryParameters& battery);
  asset::BatteryParameters parameters() const;
};

struct ElectricMotorFile {
  asset::ElectricMotor motor;
  BatteryFile battery;
};

/// A fixed wing as files say it: coefficients that are not mentioned are 0, and it
/// neither stalls nor has a motor unless the file says so.
struct FixedWingFile {
  FixedWingFile();

  asset::FixedWingParameters wing;
  std::optional<ElectricMotorFile> electric_motor;
  std::optional<asset::PistonEngine> piston_engine;

  static FixedWingFile of(const asset::FixedWingParameters& wing);
  asset::FixedWingParameters parameters() const;
};

/// One rotor as files say it.
struct RotorFile {
  enum class Spin { kClockwise, kCounterclockwise };
  double forward = 0, right = 0;  // [m]
  Spin spin = Spin::kClockwise;
};

struct MultirotorFile {
  asset::MultirotorParameters multirotor;
  std::vector<RotorFile> rotors;
  BatteryFile battery;

  static MultirotorFile of(const asset::MultirotorParameters& multirotor);
  asset::MultirotorParameters parameters() const;
};

/// The performance model as files say it, with one store of energy.
struct PerformanceFile {
  asset::PerformanceParameters performance;
  std::optional<asset::FuelTankParameters> tank;
  std::optional<BatteryFile> battery;

  static PerformanceFile of(const asset::PerformanceParameters& performance);
  asset::PerformanceParameters parameters() const;
};

scenario::Fields<FixedWingFile> fixed_wing_fields();
scenario::Fields<MultirotorFile> multirotor_fields();
scenario::Fields<PerformanceFile> performance_fields();

// Parts of several.
scenario::Fields<asset::Inertia> inertia_fields();
scenario::Fields<BatteryFile> battery_fields();
scenario::Fields<asset::FuelTankParameters> tank_fields();
scenario::Fields<asset::GroundContactParameters> ground_fields();

/// Errors that the asset layer finds, at the keys of the file. They are asked when every
/// key of the part is valid by itself.
///
/// @param keys  of the part that the errors are about.
std::vector<scenario::RuleViolation> at_file_keys(
    const scenario::Object& keys, const std::vector<asset::ParameterError>& errors);

/// The path in a file of what the asset layer calls `member`, as `aero.CLa` or
/// `envelope.slowest`: keys are named like members, with their unit. A part of the path
/// that no key is named like is left out.
std::string file_key(const scenario::Object& keys, std::string_view member);

}  // namespace skein::assemble
