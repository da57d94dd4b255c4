// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/solve/allocation/coalitions.h"

namespace skein::solve {

/// Utilities that differ by less, for each unit of the largest of them and of costs,
/// count as equal: an answer that is proven may be that much below the best.
inline constexpr double kProofTolerance = 1e-9;

/// What a proof rests on, for checking it: parts of all allocations, each with the prices
/// by aircraft that bounded it, and the membership by which it was split where they did
/// not close it.
struct CoalitionProof {
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
  struct Part {
    std::vector<double> price;
    std::size_t task = 0, aircraft = 0;         ///< of the membership
    std::size_t with = kNone, without = kNone;  ///< parts; none: it was not split
  };
  std::vector<Part> parts;  ///< the first one is all allocations
};

/// Bounds the utility from above, and betters the answer where that finds something
/// better.
///
/// Column generation over groups: the relaxation in which an aircraft may be shared by
/// groups prices each aircraft; for any prices p
///
///   u <= sum_i p_i + sum_k max over G of ( u_k(G) - sum_(i in G) p_i )
///
/// (p >= 0 where an aircraft may be idle), which holds whatever the rounding of the
/// linear program; the rounding of the sums themselves is added. Branch and price goes
/// on: an aircraft is made a member of a task, or not, until nothing better is left;
/// without `effort.prove` for 30 parts only. Memberships that cannot be part of anything
/// better are struck out first: those with which the same prices bound the part by no
/// more than the answer.
///
/// @param answer  an allocation; `bound` and `proven` are set, `task` and `value`
///                replaced by better ones. `bound` is no less than the best utility
///                also where the answer is proven: up to kProofTolerance above it.
/// @param proof   what it rests on; none: it is not kept.
/// Reference: [Barnhart98].
void bound_coalitions(const CoalitionProblem& problem, const Effort& effort,
                      CoalitionAnswer& answer, CoalitionProof* proof = nullptr);

}  // namespace skein::solve
