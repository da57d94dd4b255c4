// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "skein/layer/reasoning/avoidance/pairwise/pair_negotiation.h"

namespace skein::reasoning {

/// Flights of a group that are to be parted together.
struct JointProblem {
  struct Member {
    NegotiatingFlight flight;
    /// Of those who are not in the group: they go on, whatever the group does.
    std::vector<KnownFlight> others;
  };
  std::vector<Member> members;
  std::vector<Separation> kept;  ///< of members i and j, at i * members.size() + j
  double begin = 0;              ///< no flight changes before [s]
  double look_until = 0;         ///< encounters after it do not count [s]
  /// Whether zones and ground leave a flight free; empty: they do.
  std::function<bool(const FlightPlan&)> is_free;
};

/// What one member does.
struct JointChoice {
  NegotiatedConflict conflict;  ///< that the manoeuvre is about: its times and separation
  Manoeuvre manoeuvre;          ///< going on: the plan, from `begin` on
  FlightPlan flight;
  double cost = 0;  ///< [s]
};

struct JointSolution {
  std::vector<JointChoice> choices;  ///< of each member
  double cost = 0;                   ///< sum of the choices' [s]
  std::size_t conflicts = 0;         ///< that are left between members
};

/// One manoeuvre for each member, so that all are apart, for little cost in sum.
///
/// All go on at first. Then again and again the earliest conflict is solved: of all pairs
/// of what its two members can do, by itself and with what the others have chosen so far,
/// the cheapest one that is apart. Once all are apart each member in turn, and then each
/// two together, take the cheapest of what they were found to be able to do that keeps
/// all apart, until nothing changes. The same input gives the same answer.
///
/// A* over joint states without a lower bound of what is to come, as [Sislak11] has it,
/// does not end within the time for more than a few members.
///
/// @param max_encounters  pairs of flights that are looked at, at most: some 5 us each.
/// @returns  the best that was found: the least conflicts, of these the least cost.
/// Reference: spec/team.md section 7.
JointSolution solve_jointly(const JointProblem& problem, std::size_t max_encounters);

}  // namespace skein::reasoning
