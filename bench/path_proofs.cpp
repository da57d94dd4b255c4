// SPDX-License-Identifier: Apache-2.0
// Bounds and claims of planned paths against computations that share no code with the
// planner. Prints what was claimed and how many claims are false; exits with 1 when any
// is.
//
//   path_proofs [PROBLEMS [FIRST]]

#include <fmt/format.h>

#include <cstdlib>

#include "skein/solve/path/test/path_campaign.h"

int main(int argc, char** argv) {
  const auto number = [&](int index, std::uint32_t otherwise) {
    return argc > index
               ? static_cast<std::uint32_t>(std::strtoul(argv[index], nullptr, 10))
               : otherwise;
  };
  const std::uint32_t count = number(1, 10'000);
  const std::uint32_t first = number(2, 1'000'000);  // not those of the tests
  skein::solve::test::PathTally all;
  for (std::uint32_t k = first; k < first + count; ++k) {
    const auto one = skein::solve::test::check_path_claims(k);
    if (!one.is_good()) fmt::print("{}\n", one.first);
    all.add(one);
  }
  fmt::print(
      "paths: {} problems, {} paths, {} bounds, {} false; {} shortest of their kind, {} "
      "false; {} parted, {} false; {} paths not as claimed; {} flights of another "
      "search, "
      "{} of them quicker than the path\n",
      all.problems, all.paths, all.bounds, all.false_bounds, all.shortest,
      all.false_shortest, all.parted, all.false_parted, all.false_paths, all.flights,
      all.quicker);
  return all.is_good() ? 0 : 1;
}
