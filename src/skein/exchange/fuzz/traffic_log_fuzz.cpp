// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "skein/exchange/traffic/traffic_log.h"

// Any bytes: no crash; what is accepted is finite, in order and not empty, what is not
// has a message.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace skein;
  static const geo::LocalFrame frame = geo::LocalFrame::at({50, 14, 0}).value();
  const std::string text(reinterpret_cast<const char*>(data), size);
  const auto log = exchange::parse_traffic_log(text, "fuzz", {frame, 1.7e9});
  if (!log) {
    if (log.error().message.empty()) std::abort();
    return 0;
  }
  if (log.value().flights.empty()) std::abort();
  for (const exchange::LoggedFlight& flight : log.value().flights) {
    if (flight.places.empty()) std::abort();
    for (std::size_t k = 0; k < flight.places.size(); ++k) {
      if (!flight.places[k].p_N.allFinite() || !std::isfinite(flight.places[k].time))
        std::abort();
      if (k > 0 && flight.places[k].time <= flight.places[k - 1].time) std::abort();
    }
  }
  return 0;
}
