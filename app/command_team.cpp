// skein team: how a team commands itself, on its own.
#include <vector>

#include "app/commands.h"
#include "app/team_commands.h"

namespace skein::app {

Command add_team(CLI::App& program, const std::atomic<bool>& stop) {
  auto* team = program.add_subcommand(
      "team", "How a team commands itself, on its own: files in, tables out.");
  team->require_subcommand(1);
  const std::vector<Command> commands = {add_team_rehearse(*team, stop)};
  team->footer("\nExamples:\n  skein team rehearse --help");
  return {team, [commands]() -> int {
            for (const Command& command : commands)
              if (*command.app) return command.run();
            return kBadUsage;
          }};
}

}  // namespace skein::app
