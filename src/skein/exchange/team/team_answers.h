// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "skein/exchange/team/team_cases.h"

namespace skein::exchange {

/// The answer to one problem, as a row of a table has it.
struct TeamAnswer {
  std::string id;
  solve::Quality quality;
  /// Coalitions: the task of each aircraft, 0 idle. Routes and tours: tasks or places in
  /// order, parted by |.
  std::string answer;
  bool feasible = true;  ///< all windows and relations are kept
};

TeamAnswer answer(const CoalitionCase& problem, const solve::Effort& effort);
/// Fails: as solve::best_sequences(), with the problem's id.
Result<TeamAnswer> answer(const SequenceCase& problem, const solve::Effort& effort);
TeamAnswer answer(const TourCase& problem, const solve::Effort& effort);

/// The first line of a table of answers.
std::string answer_header();
/// A row: id, value, answer, bound, proven (1 or 0), ms. An answer that is not feasible
/// has no value.
std::string answer_row(const TeamAnswer& answer, double milliseconds);

}  // namespace skein::exchange
