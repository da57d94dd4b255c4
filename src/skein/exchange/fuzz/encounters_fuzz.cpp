// SPDX-License-Identifier: Apache-2.0
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "skein/exchange/traffic/detection_tables.h"

// Any bytes: no crash, an error says something, and what is accepted is finite and gives
// an answer.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace skein;
  static const auto configuration = *model::well_clear_configuration("skein_suas");
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto read = exchange::read_encounters(text, "fuzz", configuration);
  if (!read) {
    if (read.error().message.empty()) std::abort();
    return 0;
  }
  static exchange::DetectionTables tables(configuration);
  constexpr std::size_t kMaxAnswered = 20;  // so that inputs stay quick
  std::string alerts, bands, guidance;
  for (std::size_t i = 0; i < read.value().size() && i < kMaxAnswered; ++i) {
    const exchange::Encounter& encounter = read.value()[i];
    if (encounter.numbers.size() != encounter.intruders.size()) std::abort();
    if (!encounter.own.p_N.allFinite() || !encounter.own.v_N.allFinite()) std::abort();
    if (encounter.intruders.size() > kMaxAnswered) continue;
    tables.add_alerts(encounter, alerts);
    tables.add_bands(encounter, bands, guidance);
  }
  if (alerts.find("nan") != std::string::npos || bands.find("nan") != std::string::npos)
    std::abort();
  return 0;
}
