// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/plan/arguments.h"

namespace CLI {  // NOLINT(readability-identifier-naming)
class App;
}

namespace skein::app {

// Each adds a sub-command to `skein plan`, whose options are read into `given`, and
// returns it.

CLI::App* add_connect(CLI::App& plan, PlanConnectArguments& given);
CLI::App* add_path(CLI::App& plan, PlanPathArguments& given);
CLI::App* add_coverage(CLI::App& plan, PlanCoverageArguments& given);
CLI::App* add_patrol(CLI::App& plan, PlanPatrolArguments& given);
CLI::App* add_orbit(CLI::App& plan, PlanOrbitArguments& given);
CLI::App* add_rendezvous(CLI::App& plan, PlanRendezvousArguments& given);
CLI::App* add_fleet(CLI::App& plan, PlanFleetArguments& given);

}  // namespace skein::app
