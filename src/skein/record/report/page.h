// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>

#include "skein/base/result.h"

namespace skein::record {

/// What a page shows.
enum class PageKind { kRuns, kStudy };

/// Writes one HTML file that holds script, style and `data` (web/report/data.ts describes
/// it) and needs nothing else. The file appears whole or not at all.
/// Fails: kUnavailable when the file cannot be written.
Result<void> write_page(PageKind kind, const std::string& title,
                        const nlohmann::ordered_json& data,
                        const std::filesystem::path& file);

/// Base64 of the bytes of numbers, for the page's packed fields.
std::string base64(std::span<const std::byte> bytes);

template <class Number>
std::string packed(const std::vector<Number>& numbers) {
  return base64(std::as_bytes(std::span(numbers)));
}

}  // namespace skein::record
