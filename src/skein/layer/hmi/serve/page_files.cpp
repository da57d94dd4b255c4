// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/hmi/serve/page_files.h"

#include <string>

namespace skein::hmi {

std::optional<HttpAnswer> page_file(std::string_view path) {
  HttpAnswer answer;
  answer.may_be_kept = true;
  for (const PageAsset& asset : page_assets()) {
    if (asset.path != path) continue;
    answer.type = asset.type;
    answer.gzip = true;
    answer.body = std::make_shared<const std::string>(asset.bytes);
    return answer;
  }
  if (path != "/") return std::nullopt;
  answer.type = "text/plain; charset=utf-8";
  answer.body = std::make_shared<const std::string>(
      "This program was built without pages (SKEIN_WEB=OFF): the feed is at /live, the "
      "run at /api/run.\n");
  return answer;
}

}  // namespace skein::hmi
