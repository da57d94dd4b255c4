// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "skein/layer/hmi/serve/web_server.h"

namespace skein::hmi {

/// A file of the operator's page, as it is built into the program.
struct PageAsset {
  std::string_view path;   ///< "/page.js"
  std::string_view type;   ///< "text/javascript; charset=utf-8"
  std::string_view bytes;  ///< compressed by gzip
};

/// All files of the page; made by web/build_live.mjs. Empty in a program that was built
/// without pages.
std::span<const PageAsset> page_assets();

/// The file of the page at a path; nothing: there is none. "/" is the page.
std::optional<HttpAnswer> page_file(std::string_view path);

}  // namespace skein::hmi
