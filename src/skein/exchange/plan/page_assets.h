// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace skein::exchange {

/// Script and style sheet of a plan's page: web/plan/ bundled at build time.
std::string_view page_script();
std::string_view page_style();

}  // namespace skein::exchange
