// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "skein/base/outages.h"
#include "skein/base/time.h"
#include "skein/link/impairment/impairment.h"

namespace skein::impairment {

struct TimedChange {
  Time at;  ///< since the begin
  Directions directions = Directions::kBoth;
  ImpairmentChange change;
};

/// What becomes of a connection over time.
struct ImpairmentPlan {
  std::array<Impairment, 2> first;  ///< by index_of(Direction)
  std::vector<TimedChange>
      changes;            ///< in any order; of equal times the later one counts
  OutageOptions outages;  ///< of both directions at once
};

/// The impairment in force: what the plan says, and what was changed by hand since.
class ImpairmentSchedule {
 public:
  explicit ImpairmentSchedule(ImpairmentPlan plan);

  /// When the next change of the plan is due; none: no more.
  std::optional<Time> next() const;

  /// Applies the next change of the plan; there must be one.
  void step();

  /// Changes what is in force, until the plan or somebody changes it again.
  void change(Directions directions, const ImpairmentChange& change);

  /// Takes back what was changed by hand.
  void reset() { in_force_ = planned_; }

  const Impairment& in_force(Direction direction) const {
    return in_force_[index_of(direction)];
  }

 private:
  std::array<Impairment, 2> planned_, in_force_;
  std::vector<TimedChange> changes_;
  std::size_t next_ = 0;
};

}  // namespace skein::impairment
