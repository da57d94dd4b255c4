// SPDX-License-Identifier: Apache-2.0
// Connections against a dense search over all six words: 100,000 random and 20,000 hard
// cases. Prints how many are found, later than the reference, and how far ends are off;
// exits with 1 when a case is later by more than 1e-9 or ends off by more than 1e-6
// radii.
//
//   connection_exactness [RANDOM [HARD [STEPS [FIRST]]]]

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "skein/model/connection/test/dense_search.h"

namespace {

using namespace skein::model;

struct Tally {
  int cases = 0, missing = 0, late = 0, irregular = 0;
  double worst_end = 0, worst_late = 0;

  void add(const ConnectionQuery& q, int steps) {
    ++cases;
    const Connection c = connect(q.from, q.to, q.air);
    if (c.status != ConnectionStatus::kFound) {
      ++missing;
      return;
    }
    irregular += c.irregular;
    worst_end = std::max(worst_end, test::end_error(q, c));
    const double reference = test::dense_search(q, c.time, steps);
    if (reference < c.time) worst_late = std::max(worst_late, 1 - reference / c.time);
    late += reference < c.time * (1 - 1e-9);
  }
  bool good() const { return missing == 0 && late == 0 && worst_end < 1e-6; }
  void print(const char* name) const {
    fmt::print(
        "{}: {} cases, {} not found, {} late (worst by {:.2g} of the time), "
        "ends within {:.2g} radii, {} irregular\n",
        name, cases, missing, late, worst_late, worst_end, irregular);
  }
};

int number(int argc, char** argv, int index, int otherwise) {
  return argc > index ? std::atoi(argv[index]) : otherwise;
}

}  // namespace

int main(int argc, char** argv) {
  const int randoms = number(argc, argv, 1, 100'000),
            hards = number(argc, argv, 2, 20'000);
  const int steps = number(argc, argv, 3, 1000);
  const int first = number(argc, argv, 4, 1'000'000);  // not the cases of the unit tests
  Tally random, hard;
  for (int i = 0; i < randoms; ++i)
    random.add(test::random_case(static_cast<std::uint32_t>(first + i)), steps);
  random.print("random");
  for (int i = 0; i < hards; ++i)
    hard.add(test::hard_case(static_cast<std::uint32_t>(first + i)), steps);
  hard.print("hard");
  return random.good() && hard.good() ? 0 : 1;
}
