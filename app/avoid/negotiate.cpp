// SPDX-License-Identifier: Apache-2.0
// skein avoid negotiate: the deals of a file of bargains.
#include <filesystem>
#include <memory>
#include <string>

#include "app/avoid/commands.h"
#include "app/common/commands.h"
#include "app/common/common.h"
#include "app/common/output.h"
#include "skein/base/output_file.h"
#include "skein/layer/reasoning/avoidance/negotiation/negotiation_batch.h"

namespace skein::app {
namespace {

constexpr const char* kNegotiateExamples = R"(
Examples:
  skein avoid negotiate --batch bargains.json --out deals.csv
A bargain: {"id": "a", "utility_1": [1, 0.7], "utility_2": [1, 0.9], "free": [[0, 1], [1, 1]]};
free[k][l] is 1 where option k of aircraft 1 and l of aircraft 2 go together.)";

struct NegotiateArguments {
  std::string batch;
  std::string out = "-";
};

int negotiate_command(const NegotiateArguments& arguments) {
  std::string text;
  if (auto good = read_text(arguments.batch, text); !good) return say_error(good.error());
  const auto bargains = reasoning::read_bargains(text, arguments.batch);
  if (!bargains) return say_error(bargains.error());
  const std::string csv = reasoning::deals_csv(bargains.value());
  if (arguments.out == "-") {
    put_out(csv);
    return kDone;
  }
  if (auto good = write_file(arguments.out, csv); !good) return say_error(good.error());
  return kDone;
}

}  // namespace

Command add_avoid_negotiate(CLI::App& avoid) {
  auto* command = avoid.add_subcommand(
      "negotiate", "Which pair of manoeuvres two aircraft agree on, by every rule.");
  const auto given = std::make_shared<NegotiateArguments>();
  command
      ->add_option(
          "--batch", given->batch,
          "JSON: a list of bargains, utilities of both and which pairs are free.")
      ->required();
  command->add_option("--out", given->out,
                      "CSV of the deals; - = standard output, the default.");
  command->footer(kNegotiateExamples);
  return {command, [given] { return negotiate_command(*given); }};
}

}  // namespace skein::app
