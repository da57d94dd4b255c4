// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <memory>

#include "app/common/commands.h"
#include "app/common/common.h"
#include "app/common/output.h"
#include "app/team/commands.h"

namespace skein::app {
namespace {

namespace fs = std::filesystem;

struct TeamToursArguments {
  TeamBatchArguments batch;
  fs::path cases;  ///< empty: the vehicles, or tours_best.csv beside it
  std::vector<std::size_t> vehicles;
};

Result<std::vector<exchange::TourCase>> read_cases(const TeamToursArguments& given) {
  std::string points, cases;
  if (auto read = read_text(given.batch.batch, points); !read) return read.error();
  const std::string place = given.batch.batch.string();
  if (!given.vehicles.empty())
    return exchange::read_tour_cases(points, place, given.vehicles);
  fs::path table = given.cases;
  const fs::path folder = given.batch.batch.parent_path();
  fs::path points_file = given.batch.batch;
  if (table.empty() && exchange::has_column(points, "vehicles")) {
    // The file says which tours are wanted; their points are beside it.
    table = given.batch.batch;
    points_file = folder / "tours_points.csv";
  } else if (table.empty() && fs::exists(folder / "tours_best.csv")) {
    table = folder / "tours_best.csv";
  }
  if (table.empty())
    return Error{ErrorCode::kBadInput, place, "how many tours are wanted is not known.",
                 "Give --vehicles 3,5 or --cases FILE with columns set and vehicles."};
  if (points_file != given.batch.batch)
    if (auto read = read_text(points_file, points); !read) return read.error();
  if (auto read = read_text(table, cases); !read) return read.error();
  if (given.cases.empty())
    complain("note: points of {}, tours of {}.\n", points_file.string(), table.string());
  return exchange::read_tour_cases(points, points_file.string(), cases, table.string());
}

int team_tours_command(const TeamToursArguments& given, const std::atomic<bool>& stop) {
  const auto cases = read_cases(given);
  if (!cases) return say_error(cases.error());
  return answer_batch(
      given.batch, cases.value().size(),
      [&](std::size_t k, const solve::Effort& effort) {
        return Result<exchange::TeamAnswer>(exchange::answer(cases.value()[k], effort));
      },
      stop);
}

}  // namespace

Command add_team_tours(CLI::App& team, const std::atomic<bool>& stop) {
  const auto given = std::make_shared<TeamToursArguments>();
  auto* command = team.add_subcommand(
      "tours", "Closed tours of several aircraft over points, the longest one short.");
  add_batch_options(*command, given->batch);
  auto* vehicles =
      command
          ->add_option("--vehicles", given->vehicles,
                       "Numbers of tours, for every set of points (comma separated).")
          ->delimiter(',')
          ->check(CLI::Range(1, 1000));
  command
      ->add_option("--cases", given->cases,
                   "Table with columns set and vehicles; without it and --vehicles, "
                   "tours_best.csv beside the points.")
      ->excludes(vehicles);
  command->footer(R"(
Examples:
  skein team tours --batch points.csv --vehicles 3,5 --out answers.csv
  skein team tours --batch points.csv --cases cases.csv --seconds 60 --out answers.csv)");
  return {command, [given, &stop] { return team_tours_command(*given, stop); }};
}

}  // namespace skein::app
