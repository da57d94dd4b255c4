// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace skein::record {

// The pages of reports: web/report/ bundled at build time. What is large is compressed
// (RFC 1950) and written in base64.

/// The page of runs, with its map.
std::string_view runs_script();
/// What the map does beside the page, in a thread of its own.
std::string_view map_worker();
/// The page of studies.
std::string_view study_script();
/// Unpacks a page's script and starts it. Text as it is.
std::string_view loader_script();
std::string_view page_style();

}  // namespace skein::record
