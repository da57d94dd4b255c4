// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "app/plan/arguments.h"

namespace skein::app {

// Groups of options that several sub-commands of `skein plan` have.

void add_output(CLI::App& command, PlanOutput& output);
void add_setting(CLI::App& command, PlanSetting& setting);
void add_limits(CLI::App& command, PlanLimits& limits);
void add_climb_acceleration(CLI::App& command, double& acceleration);
/// --slowest and --fastest.
void add_speeds(CLI::App& command, PlanLimits& limits);
/// An option that is given once for each of several things.
void add_repeated(CLI::App& command, const std::string& name,
                  std::vector<std::string>& target, const std::string& help);
void add_metres(CLI::App& command, PlanMaps& maps);
void add_zones(CLI::App& command, PlanMaps& maps);
void add_obstacles(CLI::App& command, PlanMaps& maps);

}  // namespace skein::app
