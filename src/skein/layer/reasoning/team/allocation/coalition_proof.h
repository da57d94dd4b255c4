#pragma once

#include "skein/layer/reasoning/team/allocation/coalitions.h"

namespace skein::allocation {

/// Bounds the utility from above, and betters the answer where that finds something
/// better.
///
/// Column generation over groups: the relaxation in which an aircraft may be shared by
/// groups prices each aircraft; for any prices p
///
///   u <= sum_i p_i + sum_k max over G of ( u_k(G) - sum_(i in G) p_i )
///
/// (p >= 0 where an aircraft may be idle), which holds whatever the rounding of the
/// linear program. Branch and price goes on: an aircraft is made a member of a task, or
/// not, until nothing better is left; without `effort.prove` for 30 parts only.
/// Memberships that cannot be part of anything better are struck out first.
///
/// @param answer  an allocation; `bound` and `proven` are set, `task` and `value`
/// replaced
///                by better ones.
/// Reference: [Barnhart98].
void bound_coalitions(const CoalitionProblem& problem, const Effort& effort,
                      CoalitionAnswer& answer);

}  // namespace skein::allocation
