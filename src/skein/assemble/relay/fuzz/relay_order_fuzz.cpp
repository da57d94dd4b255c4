// SPDX-License-Identifier: Apache-2.0
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "skein/assemble/relay/relay_order.h"

// Any line: no crash; what is refused says why, and what is accepted is within bounds.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace skein;
  const std::string_view line(reinterpret_cast<const char*>(data), size);
  const auto order = assemble::parse_relay_order(line);
  if (!order) {
    if (order.error().message.empty()) std::abort();
    return 0;
  }
  impairment::Impairment changed;
  apply(order.value().change, changed);
  const auto is_probability = [](double p) { return p >= 0 && p <= 1; };
  if (!is_probability(changed.loss) || !is_probability(changed.duplicate) ||
      !is_probability(changed.reorder) || !(changed.delay >= 0) || !(changed.rate >= 0) ||
      order.value().length < Time())
    std::abort();
  return 0;
}
