// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>

#include "skein/base/result.h"

namespace skein::record {

/// What the map of a report shows of the run in a directory, for its page
/// (`MapData` of web/report/data.ts) as JSON; empty: nothing. `share` is how much of the
/// room of a page it may take, up to 1.
using MapOf = std::function<Result<std::string>(const std::filesystem::path& directory,
                                                double share)>;

/// Writes one HTML file about one run or several side by side: key figures, plots, a map
/// that plays. It needs no network. Each directory holds a `run.sqlite`; a run that was
/// killed or had nothing to record is shown with what there is.
///
/// @param map_of  without it there are no maps.
/// Fails: kNotFound or kBadInput for a directory without a readable run (all of them are
/// named); kUnavailable when the page cannot be written.
Result<void> write_report(std::span<const std::filesystem::path> run_directories,
                          const std::filesystem::path& html, const MapOf& map_of = {});

}  // namespace skein::record
