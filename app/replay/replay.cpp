// SPDX-License-Identifier: Apache-2.0
// A recorded run on the operator's page.
#include "app/common/command_options.h"
#include "app/common/commands.h"
#include "app/common/common.h"
#include "app/common/output.h"
#include "app/serve/replay_player.h"
#include "app/serve/run_page.h"
#include "app/serve/terrain_bytes.h"

namespace skein::app {
namespace {

constexpr const char* kReplayExamples = R"(
Examples:
  skein replay runs/wildfire                    then open the address that is printed
  skein replay runs/wildfire --serve 8081 --speed 10
A run that is to be computed again, bit by bit: skein run --replay runs/wildfire)";

struct ReplayArguments {
  std::filesystem::path run;
  double speed = 1;
  std::optional<std::string> serve;
  serve::ServeOptions page;
};

int replay_command(const ReplayArguments& arguments, const std::atomic<bool>& stop) {
  if (auto good = check_run_folder(arguments.run); !good) return say_error(good.error());
  auto recorded = record::RecordStream::open(arguments.run);
  if (!recorded) return say_error(recorded.error());
  const auto scenario = load_recorded_scenario(arguments.run);
  if (!scenario) return kBadUsage;
  serve::ServeOptions options = arguments.page;
  if (arguments.serve && !arguments.serve->empty())
    if (auto read = serve::read_place(*arguments.serve, options); !read)
      return say_error(read.error());
  const auto page = serve::RunPage::open(
      options, serve::facts_of(*scenario, recorded.value(),
                               serve::patch_of(recorded.value().terrain())));
  if (!page) return say_error(page.error());
  complain("The page: {}\n", page.value()->place());
  const auto played =
      serve::play_again(recorded.value(), page.value()->feed(), arguments.speed, stop);
  return played ? kDone : say_error(played.error());
}

}  // namespace

Command add_replay(CLI::App& program, const std::atomic<bool>& stop) {
  const auto given = std::make_shared<ReplayArguments>();
  auto* command = program.add_subcommand(
      "replay", "Show a recorded run again, on the operator's page.");
  command->add_option("run", given->run, "Folder of the run.")->required();
  command
      ->add_option("--speed", given->speed,
                   "Recorded seconds per second; the page can change it.")
      ->check(CLI::Range(0.01, 1000.0));
  add_serve_options(*command, given->serve, given->page);
  add_log_option(*command);
  command->footer(kReplayExamples);
  return {command, [given, &stop] { return replay_command(*given, stop); }};
}

}  // namespace skein::app
