// SPDX-License-Identifier: Apache-2.0
#include "skein/exchange/team/team_answers.h"

#include <fmt/format.h>

#include <cmath>

namespace skein::exchange {
namespace {

std::string listed(const std::vector<std::vector<std::size_t>>& routes,
                   const std::vector<std::int64_t>& names) {
  std::string text;
  for (std::size_t a = 0; a < routes.size(); ++a) {
    if (a > 0) text += '|';
    for (std::size_t k = 0; k < routes[a].size(); ++k)
      text += fmt::format("{}{}", k > 0 ? " " : "", names[routes[a][k]]);
  }
  return text;
}

// A bound with nine digits, rounded away from the value: what is written still bounds.
std::string shown_bound(const solve::Quality& quality) {
  constexpr double kDigits = 1e9;
  double bound = quality.bound;
  if (std::abs(bound) < 1e6 && bound != quality.value) {  // else digits are no matter
    bound =
        bound > quality.value ? std::ceil(bound * kDigits) : std::floor(bound * kDigits);
    bound /= kDigits;
  }
  return fmt::format("{:.9f}", bound);
}

// As a cell of a table: in quotation marks where it has to be.
std::string cell(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}

}  // namespace

TeamAnswer answer(const CoalitionCase& problem, const solve::Effort& effort) {
  const auto found = solve::best_coalitions(problem.problem, effort);
  TeamAnswer row{problem.id, found.quality, "", true};
  for (std::size_t i = 0; i < found.task.size(); ++i) {
    const bool idle = found.task[i] == solve::CoalitionAnswer::kIdle;
    row.answer +=
        fmt::format("{}{}", i > 0 ? " " : "", idle ? 0 : problem.tasks[found.task[i]]);
  }
  return row;
}

Result<TeamAnswer> answer(const SequenceCase& problem, const solve::Effort& effort) {
  const auto found = solve::best_sequences(problem.problem, effort);
  if (!found) {
    Error error = found.error();
    error.place = problem.id + ": " + error.place;
    return error;
  }
  return TeamAnswer{problem.id, found.value().quality,
                    listed(found.value().routes, problem.tasks), found.value().feasible};
}

TeamAnswer answer(const TourCase& problem, const solve::Effort& effort) {
  const auto found = solve::shortest_tours(problem.problem, effort);
  return {problem.id, found.quality, listed(found.tours, problem.places), true};
}

std::string answer_header() {
  return "id,value,answer,bound,proven,ms\n";
}

std::string answer_row(const TeamAnswer& answer, double milliseconds) {
  const std::string value =
      answer.feasible ? fmt::format("{:.9f}", answer.quality.value) : "";
  return fmt::format("{},{},{},{},{},{:.3f}\n", cell(answer.id), value,
                     cell(answer.answer), shown_bound(answer.quality),
                     answer.quality.proven ? 1 : 0, milliseconds);
}

}  // namespace skein::exchange
