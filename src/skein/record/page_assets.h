#pragma once

#include <string_view>

namespace skein::record {

/// The report page's script and style sheet: web/report/ bundled at build time.
std::string_view page_script();
std::string_view page_style();

}  // namespace skein::record
