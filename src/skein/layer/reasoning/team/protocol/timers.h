// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

namespace skein::reasoning {

/// What the times of the team protocol follow from.
struct TeamTimes {
  double query_period = 1;      ///< T_q [s], between queries
  double mission_diameter = 1;  ///< L [m]; 0: of the tasks that are known
  double radio_range = 1;       ///< R [m]; 0: no limit
  double jitter = 0.1;          ///< queries come earlier or later by such a share
};

/// The share of messages that is lost, from the numbers of those that arrive.
///
/// Begins with what a bad link would have, forgets with 200 messages. A gap while nothing
/// at all arrived for long is absence, not loss: whoever measures leaves it out.
class LossMeter {
 public:
  /// One arrived, after `missing` that did not.
  void arrived(std::uint32_t missing);
  /// One arrived late that had been taken for lost.
  void arrived_late();
  /// From 0.05 to 0.9.
  double loss() const;

 private:
  double expected_ = 10, lost_ = 3;
};

/// After how long of silence somebody is lost:
///
///   T_lost = T_q max(4, ceil(ln 1e-4 / ln p)) max(1, L / R)
///
/// so that less than one in 10^4 is taken for lost who is there.
///
/// @param loss  p, from 0.05 to 0.9.
/// @returns  [s].
double time_until_lost(const TeamTimes& times, double loss);

/// How often a follower says that it is there, while it receives its leader and has
/// nothing new to say, so that each receives no more of it than in a team of twelve:
///
///   T_f = T_q max(1, min(n / 12, 5)),  at most 5 s where T_q is less
///
/// @param members  n, of the team.
/// @returns        [s].
double follower_period(const TeamTimes& times, std::size_t members);

}  // namespace skein::reasoning
