// SPDX-License-Identifier: Apache-2.0
// Proofs and bounds of allocation against computations that share no code with the
// solvers: random coalitions, as many routes, as many tours. Prints how many were called
// proven, and how many claims are false; exits with 1 when any is.
//
//   allocation_proofs [PROBLEMS [FIRST [MAX_AIRCRAFT]]]

#include <fmt/format.h>

#include <cstdlib>

#include "skein/solve/test/proof_campaign.h"

namespace {

using skein::solve::test::ProofTally;

std::uint32_t number(int argc, char** argv, int index, std::uint32_t otherwise) {
  return argc > index ? static_cast<std::uint32_t>(std::strtoul(argv[index], nullptr, 10))
                      : otherwise;
}

template <class Check>
bool campaign(const char* name, std::uint32_t first, std::uint32_t count, Check check) {
  ProofTally all;
  for (std::uint32_t k = first; k < first + count; ++k) {
    const ProofTally one = check(k);
    if (!one.is_good()) fmt::print("{}\n", one.first);
    all.add(one);
  }
  fmt::print(
      "{}: {} problems, {} answers proven, {} false proofs, {} false bounds, {} not "
      "confirmed\n",
      name, all.problems, all.proven, all.false_proofs, all.false_bounds,
      all.unconfirmed);
  return all.is_good();
}

}  // namespace

int main(int argc, char** argv) {
  const std::uint32_t count = number(argc, argv, 1, 10'000);
  const std::uint32_t first = number(argc, argv, 2, 1'000'000);  // not those of the tests
  const std::size_t aircraft = number(argc, argv, 3, 40);
  using namespace skein::solve::test;
  bool good = campaign("coalitions", first, count, [&](std::uint32_t k) {
    return check_coalition_proof(k, aircraft);
  });
  good = campaign("routes", first, count, check_route_proof) && good;
  good = campaign("tours", first, count, check_tour_proof) && good;
  return good ? 0 : 1;
}
