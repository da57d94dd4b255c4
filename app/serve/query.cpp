// SPDX-License-Identifier: Apache-2.0
#include "app/serve/query.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <memory>
#include <nlohmann/json.hpp>

#include "skein/base/shown_text.h"
#include "skein/base/valid_text.h"

namespace skein::serve {
namespace {

constexpr std::size_t kMaxValueLength = 255;  // bytes, as a file's name has at most
constexpr std::size_t kMaxShownLength = 60;   // of a name that nobody knows

// None when a %-code is broken.
std::optional<std::string> decoded(std::string_view text) {
  std::string plain;
  for (std::size_t k = 0; k < text.size(); ++k) {
    if (text[k] != '%') {
      plain += text[k] == '+' ? ' ' : text[k];
      continue;
    }
    const std::string_view code = text.substr(k + 1, 2);
    unsigned value = 0;
    const auto [end, error] =
        std::from_chars(code.data(), code.data() + code.size(), value, 16);
    if (code.size() != 2 || error != std::errc() || end != code.data() + 2)
      return std::nullopt;
    plain += static_cast<char>(value);
    k += 2;
  }
  return plain;
}

std::string shown_name(std::string_view name) {
  return shown(valid_text(name.substr(0, kMaxShownLength)));
}

}  // namespace

Result<std::map<std::string, std::string>> read_query(
    std::string_view query, std::span<const std::string_view> allowed) {
  std::map<std::string, std::string> values;
  const auto refuse = [&](std::string_view name, std::string_view why) {
    const std::string there = allowed.empty()
                                  ? "This address takes no parameters."
                                  : fmt::format("Allowed: {}.", fmt::join(allowed, ", "));
    return Error{ErrorCode::kBadInput, "",
                 fmt::format("query parameter \"{}\" {}.", shown_name(name), why), there};
  };
  while (!query.empty()) {
    const std::string_view part = query.substr(0, query.find('&'));
    query.remove_prefix(std::min(part.size() + 1, query.size()));
    if (part.empty()) continue;
    const std::string_view before = part.substr(0, part.find('='));
    const auto name = decoded(before);
    const auto value = decoded(part.substr(std::min(before.size() + 1, part.size())));
    if (!name || !value) return refuse(before, "has a % that begins no code");
    if (std::ranges::find(allowed, *name) == allowed.end())
      return refuse(*name, "is not known");
    if (!is_valid_text(*value)) return refuse(*name, "is not UTF-8");
    if (value->size() > kMaxValueLength)
      return refuse(*name, fmt::format("is longer than {} bytes", kMaxValueLength));
    if (!values.emplace(*name, *value).second) return refuse(*name, "is given twice");
  }
  return values;
}

std::optional<hmi::HttpAnswer> refused_query(std::string_view query,
                                             std::span<const std::string_view> allowed) {
  const auto values = read_query(query, allowed);
  if (values) return std::nullopt;
  const nlohmann::ordered_json said = {{"error", values.error().text()}};
  hmi::HttpAnswer answer;
  answer.status = 400;
  answer.body = std::make_shared<const std::string>(said.dump() + "\n");
  return answer;
}

}  // namespace skein::serve
