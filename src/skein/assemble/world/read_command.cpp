// SPDX-License-Identifier: Apache-2.0
#include "skein/assemble/world/read_command.h"

#include "skein/data/command/command_text.h"
#include "skein/exchange/plan/plan_reading.h"

namespace skein::assemble {

Result<Command> read_command(std::string_view line, const geo::LocalFrame& frame,
                             const TaskForms& forms) {
  auto command = parse_command(line, forms);
  if (!command) return command;
  auto* task = std::get_if<TaskCommand>(&command.value());
  if (!task || task->file.empty()) return command;
  auto plan = exchange::read_plan(task->file, frame);
  if (!plan) return plan.error();
  if (auto* flown = std::get_if<FlyPlan>(&task->what))
    flown->plan = std::move(plan).value();
  return command;
}

}  // namespace skein::assemble
