// SPDX-License-Identifier: Apache-2.0
// What is called proven, and what bounds say, against computations that share no code
// with the solvers. bench/allocation_proofs does the same with ten thousand problems.

#include <gtest/gtest.h>

#include <cmath>

#include "skein/solve/test/independent_coalitions.h"
#include "skein/solve/test/independent_routes.h"
#include "skein/solve/test/proof_campaign.h"

namespace skein::solve::proofs_test {
namespace {

void expect_good(const test::ProofTally& tally, int problems) {
  EXPECT_EQ(tally.problems, problems);
  EXPECT_GT(tally.proven, 0);
  EXPECT_EQ(tally.false_proofs, 0) << tally.first;
  EXPECT_EQ(tally.false_bounds, 0) << tally.first;
  EXPECT_EQ(tally.unconfirmed, 0) << tally.first;
}

TEST(Proofs, OfCoalitionsHoldAgainstAllSubsets) {
  test::ProofTally tally;
  for (std::uint32_t k = 1; k <= 400; ++k)
    tally.add(test::check_coalition_proof_of(k, 5 + k % 7));
  for (std::uint32_t k = 1; k <= 20; ++k)
    tally.add(test::check_coalition_proof_of(1000 + k, 13));
  // Closed by prices of nothing, after its parts had found something better.
  tally.add(test::check_coalition_proof_of(1'003'865, 6));
  tally.add(test::check_coalition_proof_of(1'008'117, 3));
  expect_good(tally, 422);
}

TEST(Proofs, OfCoalitionsBeyondAllSubsetsHoldByTheirOwnPrices) {
  test::ProofTally tally;
  for (std::uint32_t k = 1; k <= 20; ++k)
    tally.add(test::check_coalition_proof_of(2000 + k, 17 + k % 8));
  expect_good(tally, 20);
}

TEST(Proofs, OfRoutesHoldAgainstAllWays) {
  test::ProofTally tally;
  for (std::uint32_t k = 1; k <= 500; ++k) tally.add(test::check_route_proof(k));
  expect_good(tally, 500);
}

TEST(Proofs, OfToursHoldAgainstAllTours) {
  test::ProofTally tally;
  for (std::uint32_t k = 1; k <= 1000; ++k) tally.add(test::check_tour_proof(k));
  expect_good(tally, 1000);
}

// The checker itself: two aircraft, one of which is enough for the task.
TEST(Proofs, AreRefusedWhereTheyShowLess) {
  independent::Coalitions problem;
  problem.aircraft = 2;
  problem.tasks = {{independent::Form::kRootFromOne, {1, 2}, {0.1, 0.5}}};
  const long double best = independent::best_utility(problem);
  EXPECT_NEAR(static_cast<double>(best), std::sqrt(3.0) - 0.6, 1e-12);
  EXPECT_NEAR(static_cast<double>(independent::utility(problem, {0, 0})),
              static_cast<double>(best), 1e-15);
  EXPECT_TRUE(independent::is_proof(problem, {{{0, 0}}}, best, 1e-12L));
  EXPECT_FALSE(independent::is_proof(problem, {{{0, 0}}}, best - 0.01L, 1e-12L))
      << "what is claimed is less than what there is";
  EXPECT_FALSE(independent::is_proof(problem, {{{0.5, 0.9}}}, best, 1e-12L))
      << "these prices bound less well";
  EXPECT_FALSE(independent::is_proof(problem, {{{-1, 0}}}, best, 1e-12L))
      << "who may be idle has no price below nothing";
  EXPECT_FALSE(independent::is_proof(problem, {}, best, 1e-12L));
  // Split by the second aircraft's membership: both halves have to be closed.
  EXPECT_TRUE(independent::is_proof(
      problem, {{{0.5, 0.9}, 0, 1, 1, 2}, {{0, 0}}, {{0, 0}}}, best, 1e-12L));
  EXPECT_FALSE(independent::is_proof(problem, {{{0.5, 0.9}, 0, 1, 1, 2}, {{0, 0}}, {}},
                                     best, 1e-12L));
}

}  // namespace
}  // namespace skein::solve::proofs_test
