// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <limits>

namespace skein::solve {

/// How good an answer is known to be.
struct Quality {
  double value = 0;
  /// No answer is better: an upper bound of what is maximised, a lower one of what is
  /// minimised.
  double bound = 0;
  bool proven = false;          ///< no answer is better than this one
  std::int64_t iterations = 0;  ///< moves tried, nodes looked at

  /// How far the bound is from the value, as a share of the larger of both; 0 when
  /// proven.
  double gap() const;
};

/// How much work a search may do. Without `used` the answer depends on nothing but the
/// problem and these numbers.
struct Effort {
  /// Moves of a search. 0: as many as are usual for the problem; of a search for
  /// sequences or tours that is `timed`, as many as the time allows.
  std::int64_t iterations = 0;
  bool timed = false;  ///< `used` reaches 1 in reasonable time
  std::uint64_t seed = 1;
  bool prove = false;  ///< go on until nothing better is possible
  /// The share of the caller's time that is used up: 1 and more ends the search with the
  /// best so far. Asked now and then. Empty: time does not count.
  std::function<double()> used = {};

  /// As used(); 0 when time does not count.
  double share_used() const { return used ? used() : 0; }
  bool ended() const { return share_used() >= 1; }
  /// The moves of a search of which so many are usual.
  std::int64_t moves(std::int64_t usual) const {
    if (iterations > 0) return iterations;
    return timed ? std::numeric_limits<std::int64_t>::max() : usual;
  }
};

/// Whether an allocation of utility `found` is to replace the present one: only when it
/// is better by more than `share`, since every change costs flights that were for
/// nothing.
///
/// @param present  utility of the present allocation in the present situation.
/// @param tasks_or_aircraft_changed  one came or went: the better one counts at once.
bool is_worth_changing(double present, double found, bool tasks_or_aircraft_changed,
                       double share = 0.05);

}  // namespace skein::solve
