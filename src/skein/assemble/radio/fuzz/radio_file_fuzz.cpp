// SPDX-License-Identifier: Apache-2.0
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "skein/assemble/radio/radio_file.h"

// Any bytes: no crash, and whatever is accepted is written as a file that reads as the
// same radio.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace skein::assemble;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  static const RadioParts parts = own_radio_parts();
  const auto radio = read_radio(text, "fuzz", parts);
  if (!radio) {
    if (radio.error().message.empty()) std::abort();
    return 0;
  }
  const std::string written = write_radio(radio.value());
  const auto again = read_radio(written, "written", parts);
  if (!again || write_radio(again.value()) != written) std::abort();
  return 0;
}
