// SPDX-License-Identifier: Apache-2.0
#include <cstddef>
#include <cstdint>
#include <sstream>
#include <string>

#include "skein/base/check.h"
#include "skein/campaign/estimators/estimators_csv.h"

// Any text either gives results or says what is wrong with it. The first byte chooses the
// command, so that one corpus serves both.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string in(data + 1, data + size);
  std::ostringstream out;
  const auto problems = data[0] % 2 == 0
                            ? skein::campaign::evaluate_cases(in, "fuzz", out)
                            : skein::campaign::evaluate_updates(in, "fuzz", out);
  SKEIN_CHECK(problems.empty() == !out.str().empty(), problems.size());
  SKEIN_CHECK(out.str().find("nan") == std::string::npos);
  return 0;
}
