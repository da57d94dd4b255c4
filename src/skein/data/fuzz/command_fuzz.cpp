// SPDX-License-Identifier: Apache-2.0
// Any line is refused, or gives a command that can be coded and read back, and whose
// texts are valid.

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "skein/base/check.h"
#include "skein/data/command/command_text.h"
#include "skein/data/describe/json.h"
#include "skein/data/describe/wire.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto command =
      skein::parse_command(std::string_view(reinterpret_cast<const char*>(data), size));
  if (!command) return 0;
  std::vector<std::byte> coded;
  skein::wire::encode(command.value(), coded);
  SKEIN_CHECK(skein::wire::decode<skein::Command>(coded).ok());
  static_cast<void>(skein::json::to_json(command.value()).dump());  // throws for others
  const auto* change = std::get_if<skein::ZoneChange>(&command.value());
  if (!change) return 0;
  SKEIN_CHECK(!change->zone.name.empty());
  const auto* ring = std::get_if<skein::geo::Ring>(&change->zone.area);
  const bool named_only = ring && ring->empty();
  SKEIN_CHECK(named_only || !skein::error_in(change->zone));
  return 0;
}
