// SPDX-License-Identifier: Apache-2.0
// What commands of `skein team` that answer files of problems share.
#include <fmt/format.h>

#include <chrono>
#include <thread>

#include "app/common/commands.h"
#include "app/common/common.h"
#include "app/common/number_range.h"
#include "app/common/output.h"
#include "app/team/commands.h"
#include "skein/base/output_file.h"

namespace skein::app {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// The effort for one problem that begins now.
solve::Effort effort_of(const TeamBatchArguments& given, const std::atomic<bool>& stop) {
  solve::Effort effort;
  effort.iterations = given.iterations;
  effort.seed = given.seed;
  effort.timed = given.seconds > 0;
  effort.prove = given.prove;
  const Clock::time_point start = Clock::now();
  // Polled all the time: whoever sets no limit still can interrupt.
  effort.used = [start, seconds = given.seconds, &stop] {
    if (stop) return 1.0;
    return seconds > 0 ? seconds_since(start) / seconds : 0.0;
  };
  return effort;
}

struct Answered {
  std::optional<Result<exchange::TeamAnswer>> answer;
  double milliseconds = 0;
};

}  // namespace

void add_batch_options(CLI::App& command, TeamBatchArguments& given) {
  command.add_option("--batch", given.batch, "File of problems; see docs/allocation.md.")
      ->required();
  command.add_option("--out", given.out, "Table of answers (CSV); - = standard output.")
      ->required();
  command
      .add_option("--seconds", given.seconds,
                  "Time for each problem; the answer then depends on the machine. "
                  "Without it, a number of iterations that goes with its size.")
      ->check(number_in(0.001, 86400.0));
  command
      .add_option("--iterations", given.iterations,
                  "Iterations for each problem, instead of what goes with its size.")
      ->check(CLI::Range(std::int64_t{1}, std::int64_t{1'000'000'000'000}));
  command.add_option("--seed", given.seed, "Of searches.")
      ->check(seed_number())
      ->capture_default_str();
  command
      .add_option("--threads", given.threads,
                  "Problems at a time; answers are the same for any number.")
      ->capture_default_str()
      ->check(CLI::Range(1, 256));
}

int answer_batch(
    const TeamBatchArguments& given, std::size_t count,
    const std::function<Result<exchange::TeamAnswer>(std::size_t, const solve::Effort&)>&
        solve,
    const std::atomic<bool>& stop) {
  std::vector<Answered> answers(count);
  std::atomic<std::size_t> next = 0;
  const auto work = [&] {
    for (std::size_t k = next++; k < count && !stop; k = next++) {
      const Clock::time_point start = Clock::now();
      answers[k].answer = solve(k, effort_of(given, stop));
      answers[k].milliseconds = 1000 * seconds_since(start);
    }
  };
  std::vector<std::thread> helpers;
  for (int k = 1; k < given.threads; ++k) helpers.emplace_back(work);
  work();
  for (std::thread& helper : helpers) helper.join();

  std::string table = exchange::answer_header();
  std::size_t proven = 0, infeasible = 0;
  for (const Answered& answered : answers) {
    if (!answered.answer) continue;  // it was interrupted before
    if (!*answered.answer) return say_error(answered.answer->error());
    const exchange::TeamAnswer& answer = answered.answer->value();
    table += exchange::answer_row(answer, answered.milliseconds);
    if (answer.quality.proven) ++proven;
    if (!answer.feasible) ++infeasible;
  }
  if (given.out == "-") {
    put_out(table);
  } else {
    if (auto written = write_file(given.out, table); !written)
      return say_error(written.error());
    print("Written: {}: {} problems, {} of them proven.\n", given.out.string(), count,
          proven);
  }
  if (infeasible > 0)
    complain(
        "note: of {} problems no answer was found that keeps all windows and "
        "relations; they have no value.\n",
        infeasible);
  return stop ? kInterrupted : kDone;
}

}  // namespace skein::app
