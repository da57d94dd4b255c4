// SPDX-License-Identifier: Apache-2.0
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "skein/exchange/team/team_answers.h"
#include "skein/exchange/team/team_cases.h"

// Any bytes as problems of all three kinds: no crash, errors with words, and what is
// small enough is answered.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace skein;
  using namespace skein::exchange;
  const std::string text(reinterpret_cast<const char*>(data), size);
  solve::Effort effort;
  effort.iterations = 50;
  const auto coalitions = read_coalition_cases(text, "fuzz", size % 2 == 0);
  if (!coalitions && coalitions.error().message.empty()) std::abort();
  if (coalitions)
    for (const CoalitionCase& c : coalitions.value())
      if (c.problem.aircraft <= 8 && c.tasks.size() <= 4) (void)answer(c, effort);
  const auto sequences = read_sequence_cases(text, "fuzz");
  if (!sequences && sequences.error().message.empty()) std::abort();
  if (sequences)
    for (const SequenceCase& c : sequences.value())
      if (c.problem.aircraft <= 4 && c.tasks.size() <= 6) (void)answer(c, effort).ok();
  const auto tours = read_tour_cases(text, "fuzz", {1, 3});
  if (!tours && tours.error().message.empty()) std::abort();
  if (tours)
    for (const TourCase& c : tours.value())
      if (c.places.size() <= 20) (void)answer(c, effort);
  const auto named =
      read_tour_cases("set,point,x,y\na,1,0,0\na,2,1,0\n", "points", text, "fuzz");
  if (!named && named.error().message.empty()) std::abort();
  return 0;
}
