// SPDX-License-Identifier: Apache-2.0
// skein team: a command that has commands, each in a file of its own.
#include <memory>

#include "app/common/commands.h"
#include "app/team/commands.h"

namespace skein::app {

Command add_team(CLI::App& program, const std::atomic<bool>& stop) {
  auto* team = program.add_subcommand(
      "team",
      "Share tasks among the aircraft of a team, rehearse how it leads itself, and see "
      "what it says.");
  team->require_subcommand(1);
  const auto commands = std::make_shared<std::vector<Command>>();
  for (auto* add : {add_team_allocate, add_team_route, add_team_tours, add_team_rehearse,
                    add_team_messages})
    commands->push_back(add(*team, stop));
  team->footer("\nExamples:\n  skein team allocate --help\n  skein team route --help");
  return {team, [commands] {
            for (const Command& command : *commands)
              if (*command.app) return command.run();
            return static_cast<int>(kBadUsage);
          }};
}

}  // namespace skein::app
