// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "skein/assemble/kinds/kind_registry.h"
#include "skein/base/result.h"
#include "skein/layer/asset/fixed_wing/parameters.h"
#include "skein/scenario/scenario.h"

namespace skein::app {

/// Skein's own kinds and those of plugins. What cannot be loaded is said on standard
/// error; then there are none.
/// @param trusted  folders of the command line whose scenarios may load libraries and
///                 start programs (trust.h).
std::optional<assemble::KindRegistry> load_kinds(
    const std::vector<std::string>& plugins,
    const std::vector<std::string>& trusted = {});

/// What the scenario of a recorded run says, without the code that it names; says all
/// problems on standard error when there are any.
std::optional<scenario::Scenario> load_recorded_scenario(
    const std::filesystem::path& run);

/// Reads a scenario with overrides, and the plugins that it names into `kinds`; says all
/// problems on standard error when there are any. The scenario names all `plugins`, those
/// of the command line too, so that it can be run again as it is written out.
std::optional<scenario::Scenario> load_scenario(const std::filesystem::path& file,
                                                const std::vector<std::string>& overrides,
                                                const std::vector<std::string>& plugins,
                                                assemble::KindRegistry& kinds);

/// Whether a folder has what a run leaves before its first step: records, and beside them
/// their scenario. Fails: kNotFound; what the folder is, and what can be done.
Result<void> check_records(const std::filesystem::path& run);
Result<void> check_run_folder(const std::filesystem::path& run);

/// The parameters of a fixed wing, built in or in a file relative to the working folder.
/// Fails: as assemble::load_aircraft; an aircraft of another kind.
Result<asset::FixedWingParameters> load_fixed_wing(const std::string& aircraft);

/// A name that is safe as the name of one folder: letters, digits, - _ and . of `name`,
/// anything else becomes -; it neither begins with a dot nor is empty ("run").
std::string folder_name(const std::string& name);

/// As a shell reads it back.
std::string shell_quoted(const std::string& text);

/// Says an error on standard error; returns the exit status for it: bad input, failure,
/// or that it was interrupted.
int say_error(const Error& error);

/// Reads a whole file into `text`. Fails: as read_file().
Result<void> read_text(const std::filesystem::path& file, std::string& text);

}  // namespace skein::app
