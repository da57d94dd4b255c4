#include "record/summary.h"

#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>

namespace skein::record {

std::optional<double> RunSummary::number(const std::string& wanted) const {
  const auto found = numbers.find(wanted);
  if (found == numbers.end()) return std::nullopt;
  return found->second;
}

Result<void> write_summary(const RunSummary& summary, const std::filesystem::path& file) {
  nlohmann::ordered_json json;
  json["version"] = summary.version;
  json["name"] = summary.name;
  json["seed"] = summary.seed;
  json["content_hash"] = summary.content_hash;
  json["interrupted"] = summary.interrupted;
  for (const auto& [name, value] : summary.numbers) {
    if (!std::isfinite(value)) continue;
    // Counts are written as whole numbers, so that other programs read them as such.
    if (value == std::floor(value) && std::abs(value) < 9e15)
      json[name] = static_cast<std::int64_t>(value);
    else
      json[name] = value;
  }

  const std::filesystem::path unfinished = file.string() + ".part";
  std::ofstream out(unfinished, std::ios::binary | std::ios::trunc);
  const auto handler = nlohmann::ordered_json::error_handler_t::replace;
  out << json.dump(2, ' ', false, handler) << '\n';
  out.close();
  std::error_code failed;
  if (out) std::filesystem::rename(unfinished, file, failed);
  if (!out || failed) {
    const std::string reason = failed ? failed.message() : std::strerror(errno);
    std::filesystem::remove(unfinished, failed);
    return Error{ErrorCode::kUnavailable, file.string(),
                 "the summary cannot be written: " + reason,
                 "check the place and its room"};
  }
  return {};
}

}  // namespace skein::record
