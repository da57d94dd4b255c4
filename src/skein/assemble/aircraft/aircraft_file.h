// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "skein/base/result.h"
#include "skein/layer/asset/fixed_wing/parameters.h"
#include "skein/layer/asset/multirotor/multirotor_parameters.h"
#include "skein/layer/asset/performance/performance_parameters.h"
#include "skein/layer/autopilot/control/fixed_wing_gains.h"
#include "skein/layer/autopilot/control/multirotor_gains.h"
#include "skein/scenario/document.h"

namespace skein::assemble {

/// An aircraft as its file describes it; docs/aircraft-files.md.
struct AircraftFile {
  std::string name;
  std::string description;  ///< one line
  // How it flies, at one fidelity or at several: at least one is there.
  std::optional<asset::FixedWingParameters> fixed_wing;
  std::optional<asset::MultirotorParameters> multirotor;
  std::optional<asset::PerformanceParameters> performance;
  // Gains of its autopilot; none: the autopilot's own.
  std::optional<autopilot::FixedWingGains> fixed_wing_gains;
  std::optional<autopilot::MultirotorGains> multirotor_gains;

  /// The plants that it has parameters for, as "fixed-wing, performance".
  std::string plants() const;
};

/// An aircraft file that is part of the program.
struct BuiltInAircraft {
  std::string_view name;  ///< of the file, without its ending
  std::string_view text;
};

/// All of them, by name.
std::span<const BuiltInAircraft> built_in_aircraft();

/// An aircraft by the name of a built-in one, or by the path of a file that ends in .yaml
/// or .yml.
///
/// @param folder  where a relative path starts.
/// Fails: no such aircraft or file; everything that is wrong with the file, in one
///        message of several lines.
Result<AircraftFile> load_aircraft(const std::string& name_or_path,
                                   const std::filesystem::path& folder);

/// An aircraft from the text of a file, which messages call `name`.
Result<AircraftFile> read_aircraft(std::string_view text, const std::string& name);

/// The aircraft as a file with every key written out; reading that gives the same.
std::string write_aircraft(const AircraftFile& aircraft);

/// What aircraft files look like, for their JSON Schema and documentation.
const scenario::Document& aircraft_document();

}  // namespace skein::assemble
