// SPDX-License-Identifier: Apache-2.0
// skein team messages: what a team says by radio, from the records of a run.
#include <charconv>
#include <memory>
#include <string>
#include <vector>

#include "app/common/commands.h"
#include "app/common/common.h"
#include "app/common/output.h"
#include "app/team/commands.h"
#include "skein/base/output_file.h"
#include "skein/record/figures/message_load.h"

namespace skein::app {
namespace {

constexpr const char* kMessagesExamples = R"(
Examples:
  skein team messages runs/message-load
  skein team messages runs/message-load --at 0=registration 30=survey --out load.csv
  skein team messages runs/message-load --every 10 --header 42 --out load.csv)";

struct MessagesArguments {
  std::filesystem::path run, out;
  std::vector<std::string> at;
  double every = 0;  // [s]; 0: not cut evenly
  std::uint32_t header = record::kFrameBytes;
};

// "30" or "30=survey".
Result<std::pair<std::string, double>> phase_of(const std::string& text) {
  const std::size_t sign = text.find('=');
  const std::string number = text.substr(0, sign);
  double from = 0;
  const auto [end, error] =
      std::from_chars(number.data(), number.data() + number.size(), from);
  if (error != std::errc() || end != number.data() + number.size())
    return Error{ErrorCode::kBadInput, "--at",
                 fmt::format("\"{}\" is no time in seconds.", text),
                 "Say: --at 30, or --at 30=survey."};
  const std::string name =
      sign == std::string::npos ? number + " s" : text.substr(sign + 1);
  return std::pair(name, from);
}

int messages_command(const MessagesArguments& given) {
  std::vector<std::pair<std::string, double>> starts;
  for (const std::string& text : given.at) {
    auto start = phase_of(text);
    if (!start) return say_error(start.error());
    starts.push_back(std::move(start).value());
  }
  const auto run = record::read_sent_messages(given.run);
  if (!run) return say_error(run.error());
  constexpr double kMaxPhases = 10'000;
  if (given.every > 0 && run.value().duration / given.every > kMaxPhases)
    return say_error({ErrorCode::kBadInput, "--every",
                      fmt::format("{:g} s make more than {:g} phases of a run of {:g} s.",
                                  given.every, kMaxPhases, run.value().duration),
                      "Give longer phases."});
  if (given.every > 0)
    for (double from = 0; from < run.value().duration; from += given.every)
      starts.emplace_back(fmt::format("{:g} s", from), from);
  auto phases = record::load_phases(starts, run.value().duration);
  if (!phases) return say_error(phases.error());
  record::MessageLoad load(std::move(phases).value(), given.header);
  for (const record::SentMessage& message : run.value().messages) load.add(message);
  if (!given.out.empty())
    if (auto good = write_file(given.out, record::message_load_csv(load, run.value()));
        !good)
      return say_error(good.error());
  print("{}", record::message_load_text(load, run.value()));
  print("Each message is as long as its wire form and {} bytes of header.\n",
        given.header);
  return kDone;
}

}  // namespace

Command add_team_messages(CLI::App& team, const std::atomic<bool>&) {
  auto* command = team.add_subcommand(
      "messages", "What aircraft say by radio in a run: bytes/s by kind and phase.");
  const auto given = std::make_shared<MessagesArguments>();
  command->add_option("run", given->run, "Folder of the run.")->required();
  command->add_option("--at", given->at,
                      "Times in seconds at which phases begin, such as 30 or 30=survey.");
  command
      ->add_option("--every", given->every,
                   "Instead: phases of so many seconds, for bytes/s against time.")
      ->check(CLI::Range(1.0, 1e6))
      ->excludes("--at");
  command
      ->add_option("--header", given->header,
                   "Bytes that each message has besides its wire form; default 18, an "
                   "XBee modem's frame. Authenticated ones have 24 more.")
      ->check(CLI::Range(0, 1000));
  command->add_option("--out", given->out,
                      "CSV: phase, from_s, until_s, entity, kind, messages, bytes, "
                      "bytes_per_s.");
  command->footer(kMessagesExamples);
  return {command, [given] { return messages_command(*given); }};
}

}  // namespace skein::app
