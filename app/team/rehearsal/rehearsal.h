// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "app/team/rehearsal/invariants.h"
#include "app/team/rehearsal/network.h"
#include "app/team/rehearsal/script.h"

namespace skein::rehearsal {

struct TeamRehearsalOptions {
  TeamMedium medium;
  std::uint64_t seed = 1;
  double step = 0.1;    ///< [s]
  double settled = 35;  ///< after an event [s]
};

/// Whom a member follows at a moment.
struct TeamRow {
  double time = 0;  ///< [s]
  EntityId aircraft;
  TeamStatus status;
};

/// What came of a rehearsal.
struct TeamRehearsalResult {
  int expectations = 0;  ///< looked at, those of the file and those of the rules
  int met = 0;
  std::string first_missed;  ///< for people; empty: none
  /// After each event until the teams were as expected for good [s].
  std::vector<double> settling;
  int violations = 0;                                 ///< of the invariants
  std::string first_violation;                        ///< for people; empty: none
  double longest_double = 0, longest_unattended = 0;  ///< [s]
  std::uint64_t messages = 0, bytes = 0;
  std::uint64_t events = 0;            ///< messages that arrived
  std::map<std::string, int> reports;  ///< events of members, by kind
};

/// Plays a script: members step ten times a second, all at one place with equal tasks.
/// The same script, options and seed give the same result.
/// @param row  is given the status of each member every full second; may be empty.
TeamRehearsalResult rehearse(const TeamScript& script,
                             const TeamRehearsalOptions& options,
                             const std::function<void(const TeamRow&)>& row);

/// `row` as a line of comma-separated values: id, t_s, aircraft, master, mission, members
/// (ids with blanks between them); master and mission empty: none.
std::string team_row_csv(const std::string& script, const TeamRow& row);
/// The header of these lines.
std::string team_rows_header();

}  // namespace skein::rehearsal
