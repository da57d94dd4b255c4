// SPDX-License-Identifier: Apache-2.0
#include "skein/record/store/summary.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "skein/base/output_file.h"

namespace skein::record {

std::optional<double> RunSummary::number(const std::string& requested) const {
  const auto found = numbers.find(requested);
  if (found == numbers.end() || !std::isfinite(found->second)) return std::nullopt;
  return found->second;
}

namespace {

void add_numbers(const std::map<std::string, double>& numbers,
                 nlohmann::ordered_json& json) {
  for (const auto& [name, value] : numbers) {
    if (!std::isfinite(value)) continue;
    // Counts are written as whole numbers, so that other programs read them as such.
    if (value == std::floor(value) && std::abs(value) < 9e15)
      json[name] = static_cast<std::int64_t>(value);
    else
      json[name] = value;
  }
}

Result<void> write_json(const nlohmann::ordered_json& json,
                        const std::filesystem::path& file) {
  const auto handler = nlohmann::ordered_json::error_handler_t::replace;
  return write_file(file, json.dump(2, ' ', false, handler) + "\n");
}

}  // namespace

Result<void> write_summary(const RunSummary& summary, const std::filesystem::path& file) {
  nlohmann::ordered_json json;
  json["version"] = summary.version;
  json["name"] = summary.name;
  json["seed"] = summary.seed;
  json["content_hash"] = summary.content_hash;
  json["interrupted"] = summary.interrupted;
  add_numbers(summary.numbers, json);
  return write_json(json, file);
}

Result<void> write_flat_json(
    const std::vector<std::pair<std::string, std::string>>& texts,
    const std::map<std::string, double>& numbers, const std::filesystem::path& file) {
  nlohmann::ordered_json json;
  for (const auto& [name, text] : texts) json[name] = text;
  add_numbers(numbers, json);
  return write_json(json, file);
}

}  // namespace skein::record
