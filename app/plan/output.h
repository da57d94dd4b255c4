// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "app/plan/arguments.h"
#include "skein/base/result.h"
#include "skein/exchange/table/document.h"
#include "skein/exchange/table/formats.h"

namespace skein::app {

/// Whether all files that will be written have endings that say a format, and each is
/// another one, none of them an input. Asked before long work begins.
/// Fails: kBadInput; one file by two names (a link, `./`) is one file.
Result<void> check_files(const PlanOutput& output,
                         const std::vector<std::filesystem::path>& inputs);

/// Whether the formats of all files can say what is known. Asked before long work begins.
/// Fails: kBadInput.
Result<void> check_formats(const PlanOutput& output, const exchange::Known& known);

/// Writes the files of a plan.
/// Fails: as the writers of their formats; as write_file().
Result<void> write_plan_files(const exchange::Document& document,
                              const PlanOutput& output);

/// Prints the plan as JSON, whose first members are those of `about`.
void print_plan_json(const exchange::Document& document,
                     const nlohmann::ordered_json& about);

/// Writes the files and prints the plan: a table for people, or JSON, whose first members
/// are those of `about`.
/// @returns the exit status.
int put_plan(const exchange::Document& document, const nlohmann::ordered_json& about,
             const PlanOutput& output);

}  // namespace skein::app
