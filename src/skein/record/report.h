#pragma once

#include <filesystem>
#include <span>

#include "skein/base/result.h"

namespace skein::record {

/// Writes one HTML file about one run or several side by side: key figures, plots, an
/// animated map. It needs no network. Each directory holds a `run.sqlite`; a run that was
/// killed or had nothing to record is shown with what there is.
/// Fails: kNotFound or kBadInput for a directory without a readable run (all of them are
/// named); kUnavailable when the page cannot be written.
Result<void> write_report(std::span<const std::filesystem::path> run_directories,
                          const std::filesystem::path& html);

}  // namespace skein::record
