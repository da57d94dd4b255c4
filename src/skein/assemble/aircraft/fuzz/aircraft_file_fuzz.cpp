// SPDX-License-Identifier: Apache-2.0
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "skein/assemble/aircraft/aircraft_file.h"

// Any bytes: no crash, and whatever is accepted is written as a file that reads as the
// same aircraft.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace skein::assemble;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto aircraft = read_aircraft(text, "fuzz");
  if (!aircraft) {
    if (aircraft.error().message.empty()) std::abort();
    return 0;
  }
  const std::string written = write_aircraft(aircraft.value());
  const auto again = read_aircraft(written, "written");
  if (!again || write_aircraft(again.value()) != written) std::abort();
  return 0;
}
