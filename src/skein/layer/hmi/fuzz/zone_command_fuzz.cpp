// Any line is refused, or gives a change that a ground station can take up.

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "skein/base/check.h"
#include "skein/layer/hmi/zone_command.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto change = skein::hmi::parse_zone_command(
      std::string_view(reinterpret_cast<const char*>(data), size));
  if (!change) return 0;
  SKEIN_CHECK(!change.value().zone.name.empty());
  const auto* ring = std::get_if<skein::geo::Ring>(&change.value().zone.area);
  const bool named_only = ring && ring->empty();
  SKEIN_CHECK(named_only || !skein::fault_in(change.value().zone));
  return 0;
}
