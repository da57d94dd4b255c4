// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>

#include "app/common/command_options.h"

namespace skein::app {

/// `skein avoid`: its sub-commands each stand in a file of their own.
Command add_avoid(CLI::App& program);

// Each adds a sub-command to `skein avoid`.

Command add_avoid_detect(CLI::App& avoid);
Command add_avoid_negotiate(CLI::App& avoid);

}  // namespace skein::app
