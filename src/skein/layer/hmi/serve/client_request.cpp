// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/hmi/serve/client_request.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "skein/base/shown_text.h"

namespace skein::hmi {
namespace {

using Json = nlohmann::json;

constexpr std::size_t kMaxNameLength = 64;
constexpr int kMaxDepth = 32;

Error bad(const std::string& what) {
  return {ErrorCode::kBadInput, "request", what, ""};
}

bool is_count(const Json& value) {
  return value.is_number_unsigned() && value.get<std::uint64_t>() <= 0xFFFFFFFFu;
}

std::string text_of(const Json& value) {
  return value.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Result<ClientRequest> named(ClientRequest request, const std::string& name) {
  if (name.size() > kMaxNameLength) return bad("a name has 64 bytes at most.");
  request.what = NameRequest{shown(name)};
  return request;
}

}  // namespace

Result<ClientRequest> parse_client_request(std::string_view text) {
  const Json said = Json::parse(
      text, [](int depth, Json::parse_event_t, Json&) { return depth <= kMaxDepth; },
      false);
  if (!said.is_object() || said.size() != 2 || !said.contains("number"))
    return bad("it is an object with \"number\" and what is asked for.");
  if (!is_count(said["number"])) return bad("\"number\" is an integer from 0 on.");
  ClientRequest request;
  request.number = said["number"].get<std::uint32_t>();
  for (const auto& [key, value] : said.items()) {
    if (key == "number") continue;
    if (key == "line" && value.is_string()) {
      request.what = CommandRequest{value.get<std::string>()};
    } else if (key == "command" && value.is_object()) {
      request.what = CommandRequest{text_of(value)};
    } else if (key == "preview" && value.is_object()) {
      request.what = PreviewRequest{text_of(value)};
    } else if (key == "hold" && value.is_boolean()) {
      request.what = HoldRequest{value.get<bool>()};
    } else if (key == "hand_over" && is_count(value)) {
      request.what = HandOverRequest{value.get<std::uint32_t>()};
    } else if (key == "name" && value.is_string()) {
      return named(request, value.get<std::string>());
    } else if (key == "truth" && value.is_boolean()) {
      request.what = TruthRequest{value.get<bool>()};
    } else if (key == "seek_s" && value.is_number() &&
               std::isfinite(value.get<double>())) {
      request.what = SeekRequest{value.get<double>()};
    } else {
      return bad(fmt::format(
          "\"{}\" cannot be asked for so: command (object), line (text), hold (true, "
          "false), hand_over (client), name (text), truth (true, false), seek_s "
          "(number) or preview (object).",
          shown(key)));
    }
  }
  return request;
}

}  // namespace skein::hmi
