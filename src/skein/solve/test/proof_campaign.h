// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

namespace skein::solve::test {

/// What became of claims that were checked.
struct ProofTally {
  int problems = 0;
  int proven = 0;        ///< answers that were called proven
  int false_proofs = 0;  ///< of these: something better exists
  int false_bounds = 0;  ///< bounds on the wrong side of the best there is
  int unconfirmed = 0;   ///< proofs that the independent checker does not follow
  std::string first;     ///< where the first fault was; empty: none

  void add(const ProofTally& other);
  bool is_good() const { return false_proofs + false_bounds + unconfirmed == 0; }
};

/// One random problem of each kind, by its number: sizes, forms and ties among values are
/// drawn. What the solver claims is compared with independent computations
/// (independent_coalitions.h, independent_routes.h).
///
/// Coalitions: the proof is followed part by part from its prices, and to 16 aircraft the
/// best of all subsets is compared, too.
/// @param max_aircraft  the largest team: 40 in long runs. Most are of 2 to 12; one in
///                      twenty is beyond 16.
ProofTally check_coalition_proof(std::uint32_t number, std::size_t max_aircraft);
/// The same with so many aircraft.
ProofTally check_coalition_proof_of(std::uint32_t number, std::size_t aircraft);
/// Routes: last end, sum and discounted values, with windows, relations, alternatives,
/// returns.
ProofTally check_route_proof(std::uint32_t number);
/// Tours: distances, costs in wind, and costs that keep no triangle inequality.
ProofTally check_tour_proof(std::uint32_t number);

}  // namespace skein::solve::test
