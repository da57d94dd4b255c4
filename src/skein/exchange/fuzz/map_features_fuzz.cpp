// SPDX-License-Identifier: Apache-2.0
#include <cpl_vsi.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include "skein/exchange/gis/zones.h"

// Any bytes as GeoJSON, as KML and as what a page sends (.plan too): no crash, and what
// is accepted is finite and sane.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace skein;
  using namespace skein::exchange;
  static const geo::LocalFrame frame = geo::LocalFrame::at({50, 14, 0}).value();
  std::vector<std::uint8_t> bytes(data, data + size);
  for (const std::string name : {"/vsimem/fuzz.geojson", "/vsimem/fuzz.kml", "sent"}) {
    const bool sent = name == "sent";
    if (!sent)
      VSIFCloseL(VSIFileFromMemBuffer(name.c_str(), bytes.data(), bytes.size(), FALSE));
    std::vector<std::string> warnings;
    const auto features = sent
                              ? read_map_text({reinterpret_cast<const char*>(data), size},
                                              name, frame, warnings)
                              : read_map(name, &frame, warnings);
    if (!sent) VSIUnlink(name.c_str());
    if (!features) {
      if (features.error().message.empty()) std::abort();
      continue;
    }
    for (const MapFeature& feature : features.value()) {
      if (feature.points.empty()) std::abort();
      for (const Vec2& p : feature.points)
        if (!p.allFinite()) std::abort();
    }
    if (const auto zones = zones_of(features.value()))
      for (const Zone& zone : zones.value())
        if (!(geo::signed_area(outline(zone)) > 0)) std::abort();
    (void)area_of(features.value()).ok();
    (void)line_of(features.value()).ok();
    (void)movers_of(features.value()).ok();
  }
  return 0;
}
