// SPDX-License-Identifier: Apache-2.0
// Any bytes are bargains or an error that says what is wrong; bargains have a row each.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "skein/base/check.h"
#include "skein/layer/reasoning/avoidance/negotiation/negotiation_batch.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto bargains = skein::reasoning::read_bargains(text, "fuzz");
  if (!bargains) {
    SKEIN_CHECK(!bargains.error().message.empty());
    return 0;
  }
  const std::string csv = skein::reasoning::deals_csv(bargains.value());
  const auto lines = std::count(csv.begin(), csv.end(), '\n');
  SKEIN_CHECK(static_cast<std::size_t>(lines) == bargains.value().size() + 1);
  return 0;
}
