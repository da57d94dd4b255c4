// SPDX-License-Identifier: Apache-2.0
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "skein/exchange/traffic/well_clear_json.h"
#include "skein/model/well_clear/bands.h"

// Any bytes: no crash, an error says something, and what is accepted is the same when it
// is written and read again, and makes bands.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace skein;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto read = exchange::well_clear_configuration_from_json(text, "fuzz");
  if (!read) {
    if (read.error().message.empty()) std::abort();
    return 0;
  }
  const std::string written = exchange::to_json(read.value());
  const auto again = exchange::well_clear_configuration_from_json(written, "fuzz");
  if (!again || exchange::to_json(again.value()) != written) std::abort();
  model::BandMaker maker(read.value());
  const model::AircraftMotion own{Vec3(0, 0, -200), Vec3(20, 0, 0)};
  model::Intruder intruder;
  intruder.motion = {Vec3(900, 40, -210), Vec3(-25, 3, 1)};
  for (std::size_t k = 0; k < model::kManoeuvreKinds; ++k)
    if (maker.bands(static_cast<model::ManoeuvreKind>(k), own, {&intruder, 1})
            .pieces.empty())
      std::abort();
  return 0;
}
