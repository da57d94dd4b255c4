// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/scenario/kind_table.h"
#include "skein/scenario/scenario.h"
#include "skein/simulation/run_options.h"

namespace skein::assemble {

/// Steps and periods of a scenario's run; without its commands.
simulation::RunOptions run_options(const scenario::Scenario& scenario,
                                   const scenario::KindTable& kinds);

}  // namespace skein::assemble
