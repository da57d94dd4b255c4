// SPDX-License-Identifier: Apache-2.0
// skein team rehearse: who leads whom when members of a team crash, join, are parted.
#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/common/commands.h"
#include "app/common/common.h"
#include "app/common/number_range.h"
#include "app/common/output.h"
#include "app/team/commands.h"
#include "app/team/rehearsal/expected_teams.h"
#include "app/team/rehearsal/rehearsal.h"
#include "skein/base/output_file.h"

namespace skein::app {
namespace {

constexpr const char* kRehearseExamples = R"(
Examples:
  skein team rehearse --scripts scripts.json --out rows.csv
  skein team rehearse --scripts scripts.json --loss 0.3 --seed 7
  skein team rehearse --random 1000 --loss 0.3
A script: {"id": "a", "aircraft": [1, 4], "tasks": 3, "end_s": 200, "events": [
  {"t_s": 60, "what": "crash", "aircraft": 1}, {"t_s": 110, "what": "join", "aircraft": 9}]})";

struct RehearseArguments {
  std::string scripts, out;
  std::optional<int> random;
  int max_aircraft = 8;
  rehearsal::TeamRehearsalOptions options;
  std::uint64_t seed = 1;
};

// What came of all rehearsals together.
struct Totals {
  int scripts = 0, expectations = 0, met = 0, changes = 0, late = 0, violations = 0;
  double settling = 0, longest_double = 0, longest_unattended = 0, time = 0;
  std::uint64_t messages = 0, bytes = 0, arrived = 0;
  std::string first_missed, first_violation;
  std::map<std::string, int> reports;

  void add(const rehearsal::TeamScript& script,
           const rehearsal::TeamRehearsalResult& result, double allowed) {
    ++scripts;
    time += script.end;
    expectations += result.expectations;
    met += result.met;
    violations += result.violations;
    for (std::size_t k = 1; k < result.settling.size(); ++k) {
      ++changes;
      late += result.settling[k] > allowed ? 1 : 0;
      settling = std::max(settling, result.settling[k]);
    }
    longest_double = std::max(longest_double, result.longest_double);
    longest_unattended = std::max(longest_unattended, result.longest_unattended);
    messages += result.messages;
    bytes += result.bytes;
    arrived += result.events;
    if (first_missed.empty()) first_missed = result.first_missed;
    if (first_violation.empty()) first_violation = result.first_violation;
    for (const auto& [kind, count] : result.reports) reports[kind] += count;
  }
};

void print_totals(const Totals& totals, double allowed) {
  print("{} scripts, {:.0f} s, {} messages ({:.1f} kbit/s), {} arrivals\n",
        totals.scripts, totals.time, totals.messages,
        static_cast<double>(totals.bytes) * 8e-3 / std::max(1.0, totals.time),
        totals.arrived);
  print("expectations met: {} of {}\n", totals.met, totals.expectations);
  print("changes: {}, settled for good within {:.0f} s: {}, the slowest {:.1f} s\n",
        totals.changes, allowed, totals.changes - totals.late, totals.settling);
  print(
      "invariants: {} violations; longest double execution {:.1f} s, longest task "
      "without an executor {:.1f} s\n",
      totals.violations, totals.longest_double, totals.longest_unattended);
  std::string reports;
  for (const auto& [kind, count] : totals.reports)
    reports += fmt::format("{}{} {}", reports.empty() ? "" : ", ", kind, count);
  print("events of members: {}\n", reports.empty() ? "none" : reports);
  if (!totals.first_missed.empty()) print("first not met: {}\n", totals.first_missed);
  if (!totals.first_violation.empty())
    print("first violation: {}\n", totals.first_violation);
}

Result<std::vector<rehearsal::TeamScript>> scripts_of(const RehearseArguments& given) {
  if (given.random) {
    std::vector<rehearsal::TeamScript> scripts;
    for (int k = 0; k < *given.random; ++k)
      scripts.push_back(
          rehearsal::random_team_script(given.seed, static_cast<std::uint32_t>(k),
                                        static_cast<std::uint32_t>(given.max_aircraft)));
    return scripts;
  }
  std::string text;
  if (auto good = read_text(given.scripts, text); !good) return good.error();
  return rehearsal::read_team_scripts(text, given.scripts);
}

int rehearse_command(const RehearseArguments& given, const std::atomic<bool>& stop) {
  auto scripts = scripts_of(given);
  if (!scripts) return say_error(scripts.error());
  rehearsal::TeamRehearsalOptions options = given.options;
  options.seed = given.seed;
  const double allowed = 2 * reasoning::time_until_lost({}, options.medium.loss);
  std::string rows = rehearsal::team_rows_header();
  Totals totals;
  for (const rehearsal::TeamScript& script : scripts.value()) {
    if (stop) return kInterrupted;
    std::function<void(const rehearsal::TeamRow&)> keep;
    if (!given.out.empty())
      keep = [&](const rehearsal::TeamRow& row) {
        rows += rehearsal::team_row_csv(script.id, row);
      };
    totals.add(script, rehearsal::rehearse(script, options, keep), allowed);
  }
  if (!given.out.empty())
    if (auto good = write_file(given.out, rows); !good) return say_error(good.error());
  print_totals(totals, allowed);
  return kDone;
}

}  // namespace

Command add_team_rehearse(CLI::App& team, const std::atomic<bool>& stop) {
  auto* command = team.add_subcommand(
      "rehearse", "Who leads whom when aircraft crash, join, and lose contact.");
  const auto given = std::make_shared<RehearseArguments>();
  auto* scripts =
      command->add_option("--scripts", given->scripts, "JSON: a list of scripts.");
  auto* random =
      command
          ->add_option("--random", given->random, "Play so many scripts made by chance.")
          ->check(CLI::Range(1, 1000000))
          ->excludes(scripts);
  command
      ->add_option("--max-aircraft", given->max_aircraft,
                   "Of scripts made by chance; default 8.")
      ->check(CLI::Range(2, 40))
      ->needs(random);
  command->add_option("--out", given->out,
                      "CSV of who follows whom, every second: id, t_s, aircraft, master, "
                      "mission, members.");
  auto& medium = given->options.medium;
  command->add_option("--loss", medium.loss, "Share of messages that is lost; default 0.")
      ->check(number_in(0.0, 0.99));
  command->add_option("--delay", medium.delay, "Of every message in seconds; default 0.")
      ->check(number_in(0.0, 60.0));
  command
      ->add_option("--delay-spread", medium.jitter,
                   "Up to so many seconds more, so that messages overtake; default 0.")
      ->check(number_in(0.0, 60.0));
  command
      ->add_option("--duplicates", medium.duplicate,
                   "Share of messages that arrives twice; default 0.")
      ->check(number_in(0.0, 1.0));
  command->add_option("--seed", given->seed, "Of all that is drawn; default 1.")
      ->check(seed_number());
  command->footer(kRehearseExamples);
  return {command, [given, &stop] {
            if (given->scripts.empty() && !given->random) {
              complain("error: --scripts or --random is required.\n");
              return static_cast<int>(kBadUsage);
            }
            return rehearse_command(*given, stop);
          }};
}

}  // namespace skein::app
