#pragma once

#include <CLI/CLI.hpp>

#include "app/command_options.h"

namespace skein::app {

/// `skein avoid` and its sub-commands.
Command add_avoid(CLI::App& program);

/// `skein avoid negotiate`.
Command add_avoid_negotiate(CLI::App& avoid);

}  // namespace skein::app
