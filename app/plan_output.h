#pragma once

#include <nlohmann/json_fwd.hpp>

#include "app/plan_arguments.h"
#include "base/result.h"
#include "exchange/document.h"

namespace skein::app {

/// Whether all files have endings that say a format. Asked before long work begins.
Result<void> check_files(const PlanOutput& output);

/// Writes the files and prints the plan: a table for people, or JSON, whose first members
/// are those of `about`.
/// @returns the exit status.
int put_plan(const exchange::Document& document, const nlohmann::ordered_json& about,
             const PlanOutput& output);

}  // namespace skein::app
