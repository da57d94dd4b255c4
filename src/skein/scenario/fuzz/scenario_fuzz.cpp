// SPDX-License-Identifier: Apache-2.0
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include "skein/scenario/scenario_file.h"
#include "skein/scenario/test/fake_kinds.h"

// Any bytes: no crash, and whatever is accepted is written as a file that reads as the
// same scenario. Lines that start with "#set " are taken as overrides as well.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace skein::scenario;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  static const KindTable kinds = test::fake_kinds();
  std::vector<Override> overrides;
  constexpr std::string_view kMark = "#set ";
  for (std::size_t at = text.find(kMark); at != text.npos; at = text.find(kMark, at)) {
    at += kMark.size();
    overrides.push_back({std::string(text.substr(at, text.find('\n', at) - at))});
  }
  // As the scenario of a recorded run, of which less is asked.
  const ReadOutcome recorded = read_recorded_scenario_text(text, "fuzz", "/", kinds);
  if (recorded.ok() == (recorded.problem_count > 0)) std::abort();
  const ReadOutcome outcome = read_scenario_text(text, "fuzz", "/", kinds, overrides);
  if (outcome.ok() == (outcome.problem_count > 0)) std::abort();
  if (!outcome.ok()) {
    if (outcome.report().empty()) std::abort();
    return 0;
  }
  const std::string written = write_scenario(*outcome.scenario, kinds);
  const ReadOutcome again = read_scenario_text(written, "written", "/", kinds);
  if (!again.ok() || write_scenario(*again.scenario, kinds) != written) std::abort();
  return 0;
}
