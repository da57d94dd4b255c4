#pragma once

#include <CLI/CLI.hpp>
#include <atomic>

#include "app/command_options.h"

namespace skein::app {

/// `skein team` and its sub-commands.
/// @param stop  asks for an early end.
Command add_team(CLI::App& program, const std::atomic<bool>& stop);

/// `skein team rehearse`.
Command add_team_rehearse(CLI::App& team, const std::atomic<bool>& stop);

}  // namespace skein::app
