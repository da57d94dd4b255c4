// SPDX-License-Identifier: Apache-2.0
// skein avoid: keeping apart, worked out for tables of cases.
#include <vector>

#include "app/avoid/commands.h"
#include "app/common/commands.h"

namespace skein::app {

Command add_avoid(CLI::App& program) {
  auto* avoid = program.add_subcommand(
      "avoid", "Work out conflicts and how to avoid them, for tables of cases.");
  avoid->require_subcommand(1);
  const std::vector<Command> commands = {add_avoid_detect(*avoid),
                                         add_avoid_negotiate(*avoid)};
  avoid->footer(
      "\nExamples:\n  skein avoid detect --help\n  skein avoid negotiate --help");
  return {avoid, [commands] {
            for (const Command& command : commands)
              if (*command.app) return command.run();
            return static_cast<int>(kBadUsage);
          }};
}

}  // namespace skein::app
