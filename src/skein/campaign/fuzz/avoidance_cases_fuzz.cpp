// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>

#include "skein/base/check.h"
#include "skein/campaign/avoidance/avoidance_cases.h"

// Any text either gives cases that can be flown or says what is wrong with it.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(data, data + size);
  const auto cases = skein::campaign::parse_avoidance_cases(text, "fuzz");
  if (!cases) return 0;
  SKEIN_CHECK(!cases.value().empty());
  for (const auto& each : cases.value())
    for (const auto& aircraft : each.aircraft) {
      SKEIN_CHECK(aircraft.start.allFinite() && aircraft.goal.allFinite());
      SKEIN_CHECK(aircraft.airspeed > 0);
    }
  return 0;
}
