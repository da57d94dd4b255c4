// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "skein/geo/local_frame.h"
#include "skein/layer/hmi/serve/web_server.h"

namespace skein::serve {

/// Where the page sends files that are to become drawings.
inline constexpr std::string_view kDrawingsPath = "/api/drawings";

/// A map that an operator's page sends (POST, the file as the body, its name as the query
/// `name=`), read by what the command line reads maps with, as JSON for drawings:
///
///   {"features": [{"name", "purpose", "kind": "point"|"line"|"area"|"circle",
///                  "rings": [[[north_m, east_m]...]...], "radius_m"}], "notes": [""...]}
///
/// Points and circles have one ring of one point, lines one ring of theirs. A file that
/// the command line would refuse is answered with 422 and {"error"}, viewers with 403,
/// another query with 400.
hmi::HttpAnswer drawings_of(const hmi::HttpRequest& request,
                            const geo::LocalFrame& frame);

}  // namespace skein::serve
