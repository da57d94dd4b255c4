// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "skein/solve/allocation/sequence_table.h"

namespace skein::solve {

using SequenceRoutes = std::vector<std::vector<std::size_t>>;  // by aircraft

/// When everything of some routes happens, each task as early as what it waits for
/// allows.
struct SequenceSchedule {
  std::vector<double> begin;  ///< by task [s]
  std::vector<double> end;    ///< by aircraft, home or at its last task [s]; 0: stays
  double late = 0;  ///< beyond windows, in all [s]; infinite: tasks wait for each
                    ///< other without end
};
SequenceSchedule schedule_of(const SequenceTable& table, const SequenceRoutes& routes);

/// The objective as something to be minimised: of kDiscounted the negative.
double cost_of(const SequenceTable& table, const SequenceSchedule& schedule);

/// What no schedule undercuts, of the objective as a cost: what each task needs alone and
/// what all need in sum.
double cost_bound(const SequenceTable& table);

}  // namespace skein::solve
