// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/serve/serve_options.h"

namespace skein::app {

/// A command of the program, and what it does once its options are read.
struct Command {
  const CLI::App* app;
  std::function<int()> run;
};

// Options that several commands have.

/// --log
void add_log_option(CLI::App& command);
/// --plugin
void add_plugin_option(CLI::App& command, std::vector<std::string>& plugins);
/// --trust
void add_trust_option(CLI::App& command, std::vector<std::string>& folders);
/// --serve and how a page is served.
/// @param serve  set where a page is asked for; empty text: at its usual place.
void add_serve_options(CLI::App& command, std::optional<std::string>& serve,
                       serve::ServeOptions& page);
/// --set, of a scenario
void add_set_option(CLI::App& command, std::vector<std::string>& overrides);

// Commands that talk to others by links.

/// @param stop  asks for an early end.
Command add_link(CLI::App& program, const std::atomic<bool>& stop);
Command add_vehicle(CLI::App& program, const std::atomic<bool>& stop);
Command add_agent(CLI::App& program, const std::atomic<bool>& stop);
/// A bad connection between others.
Command add_relay(CLI::App& program, const std::atomic<bool>& stop);

// Runs that are over.

/// @param stop  asks for the end.
Command add_replay(CLI::App& program, const std::atomic<bool>& stop);

// The radio medium alone.

/// @param stop  asks for an early end.
Command add_net(CLI::App& program, const std::atomic<bool>& stop);

// A command of commands that share tasks among a team.

/// @param stop  asks for an early end.
Command add_team(CLI::App& program, const std::atomic<bool>& stop);

// A command of studies, each with options of its own.

/// @param stop  asks for an early end.
Command add_study(CLI::App& program, const std::atomic<bool>& stop);

}  // namespace skein::app
