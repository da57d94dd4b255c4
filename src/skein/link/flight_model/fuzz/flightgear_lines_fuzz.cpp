// SPDX-License-Identifier: Apache-2.0
// Lines of any bytes: what is taken for a state is one that can be.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "skein/base/check.h"
#include "skein/link/flight_model/flightgear.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace skein::flight_model;
  const auto read = parse_flightgear({reinterpret_cast<const char*>(data), size});
  if (read)
    SKEIN_CHECK(check(read.value()).ok());
  else
    SKEIN_CHECK(!read.error().message.empty());
  return 0;
}
