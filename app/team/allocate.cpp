// SPDX-License-Identifier: Apache-2.0
#include <memory>

#include "app/common/commands.h"
#include "app/common/common.h"
#include "app/team/commands.h"

namespace skein::app {
namespace {

struct TeamAllocateArguments {
  TeamBatchArguments batch;
  bool no_idle = false;
};

int team_allocate_command(const TeamAllocateArguments& given,
                          const std::atomic<bool>& stop) {
  std::string text;
  if (auto read = read_text(given.batch.batch, text); !read)
    return say_error(read.error());
  const auto cases =
      exchange::read_coalition_cases(text, given.batch.batch.string(), !given.no_idle);
  if (!cases) return say_error(cases.error());
  return answer_batch(
      given.batch, cases.value().size(),
      [&](std::size_t k, const solve::Effort& effort) {
        return Result<exchange::TeamAnswer>(exchange::answer(cases.value()[k], effort));
      },
      stop);
}

}  // namespace

Command add_team_allocate(CLI::App& team, const std::atomic<bool>& stop) {
  const auto given = std::make_shared<TeamAllocateArguments>();
  auto* command = team.add_subcommand(
      "allocate",
      "Which aircraft do which task together: groups of the highest utility.");
  add_batch_options(*command, given->batch);
  command->add_flag("--no-idle", given->no_idle, "Every aircraft gets a task.");
  command->add_flag("--prove", given->batch.prove,
                    "Go on until nothing better is possible.");
  command->footer(R"(
Examples:
  skein team allocate --batch coalitions.json --out answers.csv
  skein team allocate --batch coalitions.json --no-idle --prove --seconds 5 --out -)");
  return {command, [given, &stop] { return team_allocate_command(*given, stop); }};
}

}  // namespace skein::app
