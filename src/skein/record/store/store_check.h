// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "skein/base/result.h"
#include "skein/record/store/sqlite.h"

namespace skein::record {

/// The longest run that there can be [s], and the latest time of a record: messages may
/// arrive, and forecasts be for times, after the end.
inline constexpr double kLongestRun = 4e6;
inline constexpr double kLatestRecord = 1e7;

/// The error that a stored value makes no sense.
/// @param what  where it stands: "table truth, row 7"; may be empty.
Error damaged(const Sqlite& database, const std::string& what,
              const std::string& problem);

/// Whether a database that shall be read has the tables that this program writes, or did
/// in a version that it still reads (older_tables.h): no views in their place, rows
/// numbered from 1 to at most kMaxRow, and, of a small file, sound inside. Every reader
/// of stored runs begins with it. Fails: kBadInput; what is wrong, and what can be done.
Result<void> check_store(Sqlite& database);

/// What is in a folder where a run was to be, in words for the user: what it is and what
/// can be done; as the error of whoever cannot use it. Where the run is as it should be,
/// `otherwise`.
Error state_of_run(const std::filesystem::path& folder, const Error& otherwise);

}  // namespace skein::record
