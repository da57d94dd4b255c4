// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "skein/scenario/document.h"
#include "skein/scenario/kind_table.h"
#include "skein/scenario/override.h"
#include "skein/scenario/plugins.h"
#include "skein/scenario/scenario.h"

namespace skein::scenario {

/// A scenario, or everything that is wrong with it.
struct ReadOutcome : Reading {
  std::optional<Scenario> scenario;  ///< there exactly when there is no problem

  bool ok() const { return scenario.has_value(); }
};

/// Reads a scenario file. Every key that is not given has its default; every option of
/// every choice is filled in; every file path is absolute.
///
/// @param overrides  changes from outside, applied in their order; paths in them are
///                   relative to their folder.
/// @param load       makes the kinds of the scenario's plugins known: it adds them to the
///                   table that `kinds` is. Without it a scenario can have no plugins.
/// Never throws for what a file holds. A 10 MB file takes a few seconds.
ReadOutcome read_scenario(const std::filesystem::path& path, const KindTable& kinds,
                          std::span<const Override> overrides = {},
                          const LoadPlugin& load = {});

/// A scenario file that is read once, with the map files that it names, and used again
/// and again with other overrides.
OpenedDocument open_scenario(const std::filesystem::path& path);

/// As read_scenario() of the file at the time at which it was opened. By one thread at a
/// time.
ReadOutcome read_scenario(const OpenedDocument& file, const KindTable& kinds,
                          std::span<const Override> overrides = {},
                          const LoadPlugin& load = {});

/// The same of a text, for callers that have one.
///
/// @param name    what messages call it.
/// @param folder  where relative paths in it start.
ReadOutcome read_scenario_text(std::string_view text, const std::string& name,
                               const std::filesystem::path& folder,
                               const KindTable& kinds,
                               std::span<const Override> overrides = {},
                               const LoadPlugin& load = {});

/// What the scenario of a recorded run says, for those who show the run and do not run
/// it: no plugin is loaded, no file looked for. A kind that is not Skein's is there by
/// its name alone, without options.
ReadOutcome read_recorded_scenario(const std::filesystem::path& path,
                                   const KindTable& kinds);
ReadOutcome read_recorded_scenario_text(std::string_view text, const std::string& name,
                                        const std::filesystem::path& folder,
                                        const KindTable& kinds);

/// The scenario as a YAML file with every key written out. Reading that gives an equal
/// scenario, bit by bit, when this one came from reading.
std::string write_scenario(const Scenario& scenario, const KindTable& kinds);

/// The JSON Schema (draft 2020-12) of scenario files, for editors.
std::string json_schema(const KindTable& kinds);

/// The documentation of every key and kind, in Markdown.
std::string markdown_keys(const KindTable& kinds);

}  // namespace skein::scenario
