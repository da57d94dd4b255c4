// skein avoid: keeping apart, worked out for tables of cases.
#include "app/avoid_commands.h"
#include "app/commands.h"

namespace skein::app {

Command add_avoid(CLI::App& program) {
  auto* avoid = program.add_subcommand(
      "avoid", "Work out conflicts and how to avoid them, for tables of cases.");
  avoid->require_subcommand(1);
  const std::vector<Command> commands = {add_avoid_detect(*avoid)};
  avoid->footer("\nExamples:\n  skein avoid detect --help");
  return {avoid, [commands] {
            for (const Command& command : commands)
              if (*command.app) return command.run();
            return static_cast<int>(kBadUsage);
          }};
}

}  // namespace skein::app
