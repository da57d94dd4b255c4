// skein avoid: what keeps aircraft apart, on its own.
#include <vector>

#include "app/avoid_commands.h"
#include "app/commands.h"

namespace skein::app {

Command add_avoid(CLI::App& program) {
  auto* avoid = program.add_subcommand(
      "avoid", "What keeps aircraft apart, on its own: tables in, tables out.");
  avoid->require_subcommand(1);
  const std::vector<Command> commands = {add_avoid_negotiate(*avoid)};
  avoid->footer("\nExamples:\n  skein avoid negotiate --help");
  return {avoid, [commands]() -> int {
            for (const Command& command : commands)
              if (*command.app) return command.run();
            return kBadUsage;
          }};
}

}  // namespace skein::app
