#pragma once

#include <filesystem>
#include <string>

#include "base/result.h"
#include "exchange/document.h"
#include "exchange/writers.h"

namespace skein::exchange {

/// The kinds of files that plans are written to.
enum class Format { kGeojson, kCsv, kKml, kQgcPlan, kWaypoints, kSvg, kHtml };

/// By the ending of a file's name, in capitals or not.
/// Fails: kBadInput for an unknown one; the message lists those that are known.
Result<Format> format_of(const std::filesystem::path& file);

/// The content of a file.
/// Fails: as the writer.
Result<std::string> to_text(const Document& document, Format format,
                            const WritingOptions& options);

}  // namespace skein::exchange
