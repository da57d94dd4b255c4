// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "skein/geo/local_frame.h"
#include "skein/layer/hmi/serve/fire_state.h"
#include "skein/layer/hmi/serve/web_server.h"

namespace skein::serve {

/// Whether a path is that of such a file: "/api/fire.gpkg"...
bool is_fire_file(std::string_view path);

/// What is believed of fires as a file for geographic information systems: boundaries
/// with their bands, and predictions, as `skein export` writes them.
/// @param path     "/api/fire.gpkg", ".shp.zip", ".geojson" or ".kml".
/// @param start_s  of the run, since 1970.
/// @returns  nothing for another path. Where nothing is believed yet the answer is 404.
std::optional<hmi::HttpAnswer> fire_file(std::string_view path,
                                         const hmi::FireState& fire,
                                         const geo::LocalFrame& frame,
                                         std::int64_t start_s);

}  // namespace skein::serve
