// SPDX-License-Identifier: Apache-2.0
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "skein/base/check.h"
#include "skein/campaign/campaign/campaign_file.h"

// Any text either is a campaign or gets at least one problem.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto file = skein::campaign::read_campaign_text(text, "fuzz", "/");
  if (!file) {
    SKEIN_CHECK(!file.error().text().empty());
    return 0;
  }
  SKEIN_CHECK(!file.value().figures.empty() && file.value().axes.size() <= 3);
  return 0;
}
