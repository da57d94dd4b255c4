// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <sstream>
#include <string>

#include "skein/assemble/aircraft/flight_table.h"

// Any bytes: no crash, an end, and only finite rows in rising order of time.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace skein::assemble;
  std::istringstream in(std::string(reinterpret_cast<const char*>(data), size));
  FlightTableReader table(in, "fuzz");
  const auto first = table.first();
  if (!first) {
    if (first.error().message.empty()) std::abort();
    return 0;
  }
  if (!table.start().v_B.allFinite()) std::abort();
  double last = first.value().t;
  while (true) {
    const auto row = table.next();
    if (!row || !row.value()) return 0;
    if (!(row.value()->t > last) || !row.value()->wind_N.allFinite()) std::abort();
    last = row.value()->t;
  }
}
