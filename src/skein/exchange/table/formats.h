// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "skein/base/result.h"
#include "skein/exchange/table/document.h"
#include "skein/exchange/table/writers.h"

namespace skein::exchange {

/// The kinds of files that plans are written to.
enum class Format { kGeojson, kCsv, kKml, kQgcPlan, kWaypoints, kSvg, kHtml };

/// By the ending of a file's name, in capitals or not.
/// Fails: kBadInput for an unknown one; the message lists those that are known.
Result<Format> format_of(const std::filesystem::path& file);

/// What is known of plans, whatever they are.
struct Known {
  bool place = false;     ///< on Earth
  bool altitude = false;  ///< above mean sea level
  std::size_t flights = 1;
};

Known known_of(const Document& document);

/// Whether a format can say what is known; to be asked before long work begins.
/// Fails: kBadInput when it needs to know more.
Result<void> check_known(Format format, const Known& known);

/// The content of a file.
/// Fails: as the writer.
Result<std::string> to_text(const Document& document, Format format,
                            const WritingOptions& options);

}  // namespace skein::exchange
