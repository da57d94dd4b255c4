// SPDX-License-Identifier: Apache-2.0
#include <memory>

#include "app/common/commands.h"
#include "app/common/common.h"
#include "app/team/commands.h"

namespace skein::app {
namespace {

int team_route_command(const TeamBatchArguments& given, const std::atomic<bool>& stop) {
  std::string text;
  if (auto read = read_text(given.batch, text); !read) return say_error(read.error());
  const auto cases = exchange::read_sequence_cases(text, given.batch.string());
  if (!cases) return say_error(cases.error());
  return answer_batch(
      given, cases.value().size(),
      [&](std::size_t k, const solve::Effort& effort) {
        return exchange::answer(cases.value()[k], effort);
      },
      stop);
}

}  // namespace

Command add_team_route(CLI::App& team, const std::atomic<bool>& stop) {
  const auto given = std::make_shared<TeamBatchArguments>();
  auto* command = team.add_subcommand("route",
                                      "Which aircraft does which tasks, in which order: "
                                      "the last end, the sum of ends, or "
                                      "value discounted over time.");
  add_batch_options(*command, *given);
  command->footer(R"(
Examples:
  skein team route --batch routes.json --out answers.csv
  skein team route --batch discounted.json --seconds 2 --threads 2 --out answers.csv)");
  return {command, [given, &stop] { return team_route_command(*given, stop); }};
}

}  // namespace skein::app
